#include "sim/by_span/pixel_datapath.h"

namespace phongpipe::by_span {

Cycle PixelDatapath::load_table(std::uint32_t table, Cycle asked) {
  loaded_ = table;
  values_.load_table(context_.frame.tables[table]);
  const Cycle words = context_.frame.configuration.rom_words();
  context_.result.rom_load_cycles += words;
  return std::max(asked, timing_.out() + 1) + words;
}

void PixelDatapath::run() {
  std::vector<std::uint32_t> colors;
  std::vector<Cycle> cycles;
  std::vector<ShadedPixel> pixels;
  while (spans_.wait_for_item()) {
    const Span& span = spans_.front();
    const RowSpan row = span.row;
    Cycle asked = spans_.front_seen_from();
    if (span.highlight && span.table != loaded_) asked = load_table(span.table, asked);
    if (colors.size() < phongpipe::PixelDatapath::padded(row.length)) {
      colors.resize(phongpipe::PixelDatapath::padded(row.length));
      cycles.resize(colors.size());
      pixels.resize(colors.size());
    }
    values_.shade(span, colors.data());
    blocks_.shade(span);
    framebuffer_.take(span, colors.data(), cycles.data());
    const Cycle taken = timing_.next(asked, static_cast<std::size_t>(row.length), cycles.data());
    spans_.pop(taken);
    for (int i = 0; i < row.length; ++i) {
      pixels[static_cast<std::size_t>(i)] = {static_cast<std::uint16_t>(row.x + i),
                                             static_cast<std::uint16_t>(row.y),
                                             colors[static_cast<std::size_t>(i)]};
    }
    context_.record(pixels.data(), cycles.data(), static_cast<std::size_t>(row.length));
  }
  context_.result.frame_cycles = timing_.end();
  context_.result.pixel_operations = blocks_.operations();
  wait(static_cast<double>(timing_.end()), sc_core::SC_NS);  // the kernel's clock catches up
}

}  // namespace phongpipe::by_span
