// Any ClockedDatapath, such as the Verilated RTL, in place of by_span::PixelDatapath. The queues
// are the same, but every clock of the datapath is executed.
#pragma once

#include <deque>

#include "sim/by_span/framebuffer.h"
#include "sim/datapath_driver.h"
#include "sim/pixel_timing.h"

namespace phongpipe::by_span {

class ClockedPixelDatapath : public sc_core::sc_module {
 public:
  ClockedPixelDatapath(const sc_core::sc_module_name& name, FrameContext& context,
                       TimestampedFifo<Span>& spans, Framebuffer& framebuffer,
                       ClockedDatapath& datapath)
      : sc_core::sc_module(name),
        context_(context),
        spans_(spans),
        framebuffer_(framebuffer),
        driver_(context.frame, datapath),
        timing_(context.frame.configuration, context.configuration.pixel_fifo) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(ClockedPixelDatapath);

 private:
  static constexpr Cycle kCheckInterval = 64;  // checking more often would cost simulation time

  void run();
  void deliver(const DatapathOutputs& outputs, Cycle cycle);
  std::string stuck(Cycle cycle) const;

  FrameContext& context_;
  TimestampedFifo<Span>& spans_;
  Framebuffer& framebuffer_;
  DatapathDriver driver_;
  PixelTiming timing_;
  std::deque<Span> in_flight_;  // the framebuffer needs their depths
  int delivered_ = 0;           // pixels delivered of the first span in flight
};

}  // namespace phongpipe::by_span
