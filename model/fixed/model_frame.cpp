#include "model/fixed/model_frame.h"

#include "model/fixed/front_end.h"

namespace phongpipe {

std::vector<std::uint32_t> ModelFrame::colors() const {
  std::vector<std::uint32_t> colors(framebuffer.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = framebuffer.color(i);
  return colors;
}

ModelFrame run_model(const FrameSetup& frame, const Geometry& geometry, Evaluation evaluation) {
  ModelFrame result{{}, {}, Framebuffer(frame, Framebuffer::Owners::kept), 0, 0, 0};
  const FrontEnd front_end(frame, geometry);
  // Room that is not used is not touched, and so costs nothing.
  result.stream.reserve(2 * result.framebuffer.size() * frame.passes);
  result.spans.reserve(result.framebuffer.size() * frame.passes);
  PixelDatapath datapath(frame.configuration, evaluation, frame.cue_color);
  std::vector<Span> spans;  // of a triangle, and the colours of their pixels
  std::vector<std::uint32_t> colors;
  std::vector<std::uint8_t> taken;
  TriangleWork work;
  std::uint32_t loaded = ~std::uint32_t{0};
  const auto shade = [&] {
    spans.resize(work.rows.size());
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < spans.size(); ++i) {
      front_end.span_walker().start(work.setup, work.rows[i], spans[i]);
      pixels += static_cast<std::size_t>(work.rows[i].length);
    }
    if (work.setup.plan.specular && work.setup.material->table != loaded) {
      loaded = work.setup.material->table;
      datapath.load_table(frame.tables[loaded]);
    }
    colors.resize(std::max(colors.size(), pixels + PixelDatapath::kLanes));
    taken.resize(colors.size());
    datapath.shade(spans.data(), spans.size(), colors.data());
    const std::uint32_t* color = colors.data();
    for (const Span& span : spans) {
      const RowSpan& row = span.row;
      result.spans.push_back({row, span.triangle});
      result.framebuffer.take_span(frame, span, color, taken.data());
      for (int i = 0; i < row.length; ++i) {
        result.stream.push_back(
            {static_cast<std::uint16_t>(row.x + i), static_cast<std::uint16_t>(row.y), *color++});
      }
    }
  };
  for (TriangleOrder next(front_end); !next.done(); next.advance()) {
    const SetupOutcome outcome = front_end.set_up(next.triangle(), next.pass(), work);
    if (outcome == SetupOutcome::nothing) continue;
    ++result.triangles_set_up;
    if (outcome == SetupOutcome::dropped) {
      ++result.triangles_dropped;
      continue;
    }
    bool overflow = work.setup.overflow;
    for (const RowSpan& row : work.rows) {
      overflow = overflow || !front_end.span_walker().fits(work.setup, row);
    }
    if (overflow) ++result.coefficient_overflows;
    shade();
  }
  return result;
}

}  // namespace phongpipe
