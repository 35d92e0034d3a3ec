#include "model/fixed/model_frame.h"

#include <numeric>

#include "model/fixed/front_end.h"

namespace phongpipe {

std::vector<std::uint32_t> ModelFrame::colors() const {
  std::vector<std::uint32_t> colors(framebuffer.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = color(i);
  return colors;
}

ModelFrame run_model(const FrameSetup& frame, const Geometry& geometry, Evaluation evaluation) {
  ModelFrame result{{}, {}, Framebuffer(frame), 0, 0};
  const FrontEnd front_end(frame, geometry);
  // Room that is not used is not touched, and so costs nothing.
  result.stream.reserve(2 * result.framebuffer.size());
  result.spans.reserve(result.framebuffer.size());
  PixelDatapath datapath(frame.configuration, evaluation);
  std::vector<std::uint32_t> colors, places;
  std::vector<std::uint8_t> written;
  TriangleWork work;
  std::uint32_t loaded = ~std::uint32_t{0};
  for (std::uint32_t triangle = 0; triangle < front_end.triangles(); ++triangle) {
    if (!front_end.set_up(triangle, work)) continue;
    ++result.triangles_set_up;
    if (work.setup.material != loaded) {
      loaded = work.setup.material;
      datapath.load_material(frame.materials[loaded]);
    }
    bool overflow = work.setup.overflow;
    for (const RowSpan& row : work.rows) {
      const Span span = front_end.span_walker().start(work.setup, row);
      overflow = overflow || !front_end.span_walker().fits(work.setup, row);
      const auto length = static_cast<std::size_t>(row.length);
      if (colors.size() < PixelDatapath::padded(row.length)) {
        colors.resize(PixelDatapath::padded(row.length));
        places.resize(colors.size());
        written.resize(colors.size());
      }
      datapath.shade(span, colors.data());
      result.spans.push_back({row, triangle});
      std::iota(places.begin(), places.begin() + row.length,
                static_cast<std::uint32_t>(result.stream.size()));
      result.framebuffer.write_span(frame, span, places.data(), written.data());
      for (std::size_t i = 0; i < length; ++i) {
        result.stream.push_back({static_cast<std::uint16_t>(row.x + static_cast<int>(i)),
                                 static_cast<std::uint16_t>(row.y), colors[i]});
      }
    }
    if (overflow) ++result.coefficient_overflows;
  }
  return result;
}

}  // namespace phongpipe
