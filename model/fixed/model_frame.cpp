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
  std::vector<std::uint32_t> colors;
  std::vector<std::uint8_t> taken;
  TriangleWork work;
  std::uint32_t loaded = ~std::uint32_t{0};
  const auto shade = [&](const RowSpan& row) {
    const Span span = front_end.span_walker().start(work.setup, row);
    if (span.highlight && span.table != loaded) {
      loaded = span.table;
      datapath.load_table(frame.tables[loaded]);
    }
    const auto length = static_cast<std::size_t>(row.length);
    if (colors.size() < PixelDatapath::padded(row.length)) {
      colors.resize(PixelDatapath::padded(row.length));
      taken.resize(colors.size());
    }
    datapath.shade(span, colors.data());
    result.spans.push_back({row, span.triangle});
    result.framebuffer.take_span(frame, span, colors.data(), taken.data());
    for (std::size_t i = 0; i < length; ++i) {
      result.stream.push_back({static_cast<std::uint16_t>(row.x + static_cast<int>(i)),
                               static_cast<std::uint16_t>(row.y), colors[i]});
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
      shade(row);
    }
    if (overflow) ++result.coefficient_overflows;
  }
  return result;
}

}  // namespace phongpipe
