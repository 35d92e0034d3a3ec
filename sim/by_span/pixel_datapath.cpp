#include "sim/by_span/pixel_datapath.h"

namespace phongpipe::by_span {

Cycle PixelDatapath::load_material(std::uint32_t material, Cycle asked) {
  loaded_ = material;
  values_.load_material(context_.frame.materials[material]);
  const Cycle words = context_.frame.configuration.rom_words();
  context_.result.rom_load_cycles += words;
  return std::max(asked, timing_.out() + 1) + words;
}

void PixelDatapath::run() {
  std::vector<std::uint32_t> colors;
  while (spans_.wait_for_item()) {
    const Span& span = spans_.front();
    const RowSpan row = span.row;
    Cycle asked = spans_.front_seen_from();
    if (span.material != loaded_) asked = load_material(span.material, asked);
    colors.resize(std::max(colors.size(), phongpipe::PixelDatapath::padded(row.length)));
    values_.shade(span, colors.data());
    Cycle taken = 0;
    for (int i = 0; i < row.length; ++i) {
      const ShadedPixel pixel = {static_cast<std::uint16_t>(row.x + i),
                                 static_cast<std::uint16_t>(row.y),
                                 colors[static_cast<std::size_t>(i)]};
      timing_.next(asked, framebuffer_.take(span, i, pixel));
      if (i == 0) taken = timing_.in();
      context_.record(pixel, timing_.out());
    }
    spans_.pop(taken);
  }
  context_.result.frame_cycles = timing_.end();
  wait(static_cast<double>(timing_.end()), sc_core::SC_NS);  // the kernel's clock catches up
}

}  // namespace phongpipe::by_span
