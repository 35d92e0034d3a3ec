#include "sim/by_span/clocked_pixel_datapath.h"

#include <fmt/format.h>

namespace phongpipe::by_span {

void ClockedPixelDatapath::run() {
  // Clocks without a pixel and without a span, but with room at the output, that are simulated
  // before time jumps to the next span, or ends: until the last pixel's slot is free, and longer
  // than from one pixel to the next, so that a datapath that emits one too many is caught.
  const Cycle patience = context_.frame.configuration.interval_cycles() + 2;
  Cycle last_progress = 0, idle_clocks = 0;
  for (Cycle cycle = 0;; ++cycle) {
    const bool more = spans_.wait_for_item();
    const bool visible = more && spans_.front_seen_from() <= cycle;
    const bool ready = timing_.slot_free_from() <= cycle;
    if (visible || driver_.pixels_in_flight() > 0) {
      idle_clocks = 0;
    } else if (ready) {
      ++idle_clocks;
    }
    if (idle_clocks > patience) {
      if (!more) break;
      last_progress = spans_.front_seen_from();
      cycle = last_progress - 1;
      continue;
    }
    const DatapathDriver::Outcome outcome =
        driver_.clock(visible ? &spans_.front() : nullptr, ready);
    if (outcome.span_taken) {
      in_flight_.push_back(spans_.front());
      spans_.pop(cycle);
    }
    if (outcome.pixel_taken) deliver(outcome.outputs, cycle);
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

void ClockedPixelDatapath::deliver(const DatapathOutputs& outputs, Cycle cycle) {
  for (int i = 0; i < outputs.pixels(); ++i) context_.record(outputs[i], cycle);
  if (in_flight_.empty()) return;  // pixels nobody asked for; the comparison will tell
  const Span& span = in_flight_.front();
  const int count = std::min(outputs.pixels(), span.row.length - delivered_);
  timing_.read(cycle, framebuffer_.take(span, delivered_, count, outputs));
  delivered_ += count;
  if (delivered_ == span.row.length) {
    in_flight_.pop_front();
    delivered_ = 0;
  }
}

std::string ClockedPixelDatapath::stuck(Cycle cycle) const {
  return fmt::format(
      "nothing has moved for {} cycles, at cycle {}: span queue {} of {}, {} ({} delivered), "
      "framebuffer {}",
      context_.options.watchdog_cycles, cycle, spans_.size(), spans_.depth(),
      driver_.in_flight_text(), context_.delivered,
      timing_.slot_free_from() <= cycle ? "ready" : "busy");
}

}  // namespace phongpipe::by_span
