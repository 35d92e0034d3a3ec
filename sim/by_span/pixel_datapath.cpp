#include "sim/by_span/pixel_datapath.h"

namespace phongpipe::by_span {

Cycle PixelDatapath::load_table(std::uint32_t table, Cycle asked) {
  loaded_ = table;
  values_.load_table(context_.frame.tables[table]);
  const Cycle words = context_.frame.configuration.rom_words();
  context_.result.rom_load_cycles += words;
  return std::max(asked, timing_.out() + 1) + words;
}

std::size_t PixelDatapath::shade_waiting() {
  const Span* const spans = &spans_.front();
  std::size_t count = 0, pixels = 0;
  for (; count < spans_.side_by_side() && !needs_table(spans[count]); ++count) {
    pixels += static_cast<std::size_t>(spans[count].row.length);
    framebuffer_.prefetch(spans[count]);
  }
  if (colors_.size() < pixels + phongpipe::PixelDatapath::kLanes) {
    colors_.resize(pixels + phongpipe::PixelDatapath::kLanes);
    cycles_.resize(colors_.size());
    pixels_.resize(colors_.size());
  }
  values_.shade(spans, count, colors_.data());
  return count;
}

Cycle PixelDatapath::time_pixels(Cycle asked, std::size_t length, Cycle* cycles) {
  if (lanes_ == 1) return timing_.next(asked, length, cycles);
  const Cycle taken = timing_.next(asked, (length + lanes_ - 1) / lanes_, cycles);
  for (std::size_t i = length; i-- > 0;) cycles[i] = cycles[i / lanes_];
  return taken;
}

void PixelDatapath::run() {
  while (spans_.wait_for_item()) {
    Cycle ready = 0;  // from which the next span may enter
    const Span& first = spans_.front();
    if (needs_table(first)) ready = load_table(first.table, spans_.front_seen_from());
    std::size_t end = 0;
    for (std::size_t count = shade_waiting(); count > 0; --count) {
      const Span& span = spans_.front();
      const auto length = static_cast<std::size_t>(span.row.length);
      Cycle* const cycles = cycles_.data() + end;
      blocks_.shade(span);
      framebuffer_.take(span, static_cast<int>(lanes_), colors_.data() + end, cycles);
      spans_.pop(time_pixels(std::max(ready, spans_.front_seen_from()), length, cycles));
      for (int i = 0; i < span.row.length; ++i, ++end) {
        pixels_[end] = {static_cast<std::uint16_t>(span.row.x + i),
                        static_cast<std::uint16_t>(span.row.y), colors_[end]};
      }
    }
    context_.record(pixels_.data(), cycles_.data(), end);
  }
  context_.result.frame_cycles = timing_.end();
  context_.result.pixel_operations = blocks_.operations();
  wait(static_cast<double>(timing_.end()), sc_core::SC_NS);  // the kernel's clock catches up
}

}  // namespace phongpipe::by_span
