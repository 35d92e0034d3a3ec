#include "sim/by_span/clocked_pixel_datapath.h"

#include <fmt/format.h>

namespace phongpipe::by_span {

// Clocks without a pixel and without a span that are simulated before time jumps to the next span.
// More than a datapath holds, so that one that emits what nobody asked for is caught.
constexpr Cycle kIdleClocks = 8;

void ClockedPixelDatapath::run() {
  Cycle last_progress = 0, idle_clocks = 0;
  for (Cycle cycle = 0;; ++cycle) {
    const bool more = spans_.wait_for_item();
    if (!more && driver_.pixels_in_flight() <= 0) break;
    const bool visible = more && spans_.front_seen_from() <= cycle;
    idle_clocks = visible || driver_.pixels_in_flight() > 0 ? 0 : idle_clocks + 1;
    if (more && idle_clocks > kIdleClocks) {
      last_progress = spans_.front_seen_from();
      cycle = last_progress - 1;
      continue;
    }
    const DatapathDriver::Outcome outcome =
        driver_.clock(visible ? &spans_.front() : nullptr, timing_.slot_free_from() <= cycle);
    if (outcome.span_taken) {
      in_flight_.push_back(spans_.front());
      spans_.pop(cycle);
    }
    if (outcome.pixel_taken) deliver(outcome.pixel, cycle);
    if (outcome.loading) ++context_.result.rom_load_cycles;
    if (cycle % kCheckInterval == 0) {
      context_.result.failure = driver_.misbehaviour(context_.options.watchdog_cycles);
      if (!context_.result.failure.empty()) {
        context_.result.failure += fmt::format(", at cycle {}", cycle);
        stop_simulation();
        return;
      }
    }
    if (outcome.span_taken || outcome.pixel_taken || outcome.loading ||
        (!visible && driver_.pixels_in_flight() == 0)) {
      last_progress = cycle;
    } else if (cycle - last_progress > context_.options.watchdog_cycles) {
      // The modules before this one catch up, so that the queues are reported as they stand.
      for (std::size_t i = 0; i < 2 * spans_.depth(); ++i) wait(sc_core::SC_ZERO_TIME);
      context_.result.failure = stuck(cycle);
      stop_simulation();
      return;
    }
  }
  context_.result.frame_cycles = timing_.end();
  context_.result.datapath_busy_cycles = driver_.busy_clocks();
  wait(static_cast<double>(timing_.end()), sc_core::SC_NS);  // the kernel's clock catches up
}

void ClockedPixelDatapath::deliver(const ShadedPixel& pixel, Cycle cycle) {
  context_.record(pixel, cycle);
  if (in_flight_.empty()) return;  // a pixel nobody asked for; the comparison will tell
  // A wrong place must not write outside the image; the comparison will tell that, too.
  const bool inside = framebuffer_.contains(pixel.x, pixel.y);
  const Cycle cost = inside ? framebuffer_.take(in_flight_.front(), delivered_, pixel) : 1;
  timing_.read(cycle, cost);
  if (++delivered_ == in_flight_.front().row.length) {
    in_flight_.pop_front();
    delivered_ = 0;
  }
}

std::string ClockedPixelDatapath::stuck(Cycle cycle) const {
  return fmt::format(
      "nothing has moved for {} cycles, at cycle {}: span queue {} of {}, {} pixels in "
      "pixel_datapath ({} delivered), framebuffer {}",
      context_.options.watchdog_cycles, cycle, spans_.size(), spans_.depth(),
      driver_.pixels_in_flight(), context_.delivered,
      timing_.slot_free_from() <= cycle ? "ready" : "busy");
}

}  // namespace phongpipe::by_span
