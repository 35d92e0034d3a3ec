#include "model/fixed/model_frame.h"

#include "model/fixed/front_end.h"

namespace phongpipe {

ModelFrame run_model(const FrameSetup& frame, const Geometry& geometry, Evaluation evaluation) {
  ModelFrame result{{}, {}, Framebuffer(frame), 0, 0};
  const FrontEnd front_end(frame, geometry);
  // Room that is not used is not touched, and so costs nothing.
  result.stream.reserve(2 * result.framebuffer.size());
  result.spans.reserve(result.framebuffer.size());
  PixelDatapath datapath(frame.configuration, evaluation);
  std::vector<std::uint32_t> colors;
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
      const Span span = front_end.span_walker().start(work.setup, row, overflow);
      colors.resize(std::max(colors.size(), PixelDatapath::padded(row.length)));
      datapath.shade(span, colors.data());
      result.spans.push_back({row, triangle});
      for (int i = 0; i < row.length; ++i) {
        const ShadedPixel pixel = {static_cast<std::uint16_t>(row.x + i),
                                   static_cast<std::uint16_t>(row.y),
                                   colors[static_cast<std::size_t>(i)]};
        result.framebuffer.write(pixel, Framebuffer::depth(frame, span, i),
                                 static_cast<std::uint32_t>(result.stream.size()));
        result.stream.push_back(pixel);
      }
    }
    if (overflow) ++result.coefficient_overflows;
  }
  return result;
}

}  // namespace phongpipe
