// setup_engine by the clock.
#pragma once

#include "sim/clocked_fifo.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class SetupEngine : public sc_core::sc_module {
 public:
  SetupEngine(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
              ClockedFifo<WorkHandle>& triangles)
      : sc_core::sc_module(name), context_(context), triangles_(triangles) {
    SC_METHOD(clock);
    sensitive << clk.posedge_event();
    dont_initialize();
    start_next();
  }
  SC_HAS_PROCESS(SetupEngine);

  bool done() const { return work_ == nullptr; }
  std::uint64_t moved() const { return next_triangle_; }

 private:
  void clock() {
    if (done()) return;
    if (cycles_left_ > 0) --cycles_left_;
    if (cycles_left_ > 0 || triangles_.full()) return;
    triangles_.push(work_);
    start_next();
  }

  void start_next() {
    auto work = std::make_shared<TriangleWork>();
    while (next_triangle_ < context_.front_end.triangles()) {
      if (context_.front_end.set_up(next_triangle_++, *work)) {
        work_ = std::move(work);
        cycles_left_ = context_.result.setup_cycles;
        return;
      }
    }
    work_ = nullptr;
  }

  FrameContext& context_;
  ClockedFifo<WorkHandle>& triangles_;
  std::uint32_t next_triangle_ = 0;
  WorkHandle work_;
  Cycle cycles_left_ = 0;
};

}  // namespace phongpipe::by_clock
