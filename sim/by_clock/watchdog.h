// Stops the simulation when it is complete, or when nothing moves any more; then it reports the
// state of every module.
#pragma once

#include <fmt/format.h>

#include "sim/by_clock/framebuffer.h"
#include "sim/by_clock/pixel_datapath.h"
#include "sim/by_clock/setup_engine.h"
#include "sim/by_clock/span_walker.h"

namespace phongpipe::by_clock {

struct Modules {
  const SetupEngine& setup_engine;
  const SpanWalker& span_walker;
  const PixelDatapath& pixel_datapath;
  const Framebuffer& framebuffer;
  const ClockedFifo<WorkHandle>& triangles;
  const ClockedFifo<Span>& spans;
  const ClockedFifo<DepthPixels>& pixels;
};

class Watchdog : public sc_core::sc_module {
 public:
  Watchdog(const sc_core::sc_module_name& name, FrameContext& context,
           const sc_core::sc_time& period, const Modules& modules)
      : sc_core::sc_module(name), context_(context), period_(period), modules_(modules) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(Watchdog);

 private:
  static constexpr Cycle kInterval = 64;  // checking more often would cost simulation time

  void run() {
    std::uint64_t last = 0;
    for (Cycle still = 0; !done(); still += kInterval) {
      if (still > context_.options.watchdog_cycles) {
        context_.result.failure = report();
        break;
      }
      wait(static_cast<double>(kInterval) * period_);
      context_.result.failure =
          modules_.pixel_datapath.misbehaviour(context_.options.watchdog_cycles);
      if (!context_.result.failure.empty()) break;
      const std::uint64_t moved = modules_.setup_engine.moved() + modules_.span_walker.moved() +
                                  modules_.pixel_datapath.moved() + modules_.framebuffer.moved();
      if (moved != last) still = 0;
      last = moved;
    }
    stop_simulation();
  }

  bool done() const {
    const Modules& m = modules_;
    return m.setup_engine.done() && m.triangles.empty() && m.span_walker.idle() &&
           m.spans.empty() && m.pixel_datapath.in_flight() <= 0 && m.pixels.empty() &&
           !m.framebuffer.busy();
  }

  std::string report() const {
    const Modules& m = modules_;
    return fmt::format(
        "nothing has moved for {} cycles: setup_engine {}, triangle queue {} of {}, span_walker "
        "{}, "
        "span queue {} of {}, {}, pixel queue {} of {}, "
        "framebuffer {}",
        context_.options.watchdog_cycles, m.setup_engine.done() ? "done" : "waiting",
        m.triangles.size(), m.triangles.depth(), m.span_walker.idle() ? "idle" : "waiting",
        m.spans.size(), m.spans.depth(), m.pixel_datapath.in_flight_text(), m.pixels.size(),
        m.pixels.depth(), m.framebuffer.busy() ? "busy" : "idle");
  }

  FrameContext& context_;
  sc_core::sc_time period_;
  Modules modules_;
};

}  // namespace phongpipe::by_clock
