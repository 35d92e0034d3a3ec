// setup_engine, clock by clock.
#pragma once

#include "sim/clocked_fifo.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class SetupEngine : public sc_core::sc_module {
 public:
  SetupEngine(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
              ClockedFifo<WorkHandle>& triangles)
      : sc_core::sc_module(name),
        context_(context),
        triangles_(triangles),
        next_(context.front_end) {
    SC_METHOD(clock);
    sensitive << clk.posedge_event();
    dont_initialize();
    start_next();
  }
  SC_HAS_PROCESS(SetupEngine);

  bool done() const { return work_ == nullptr; }
  std::uint64_t moved() const { return moved_; }

 private:
  void clock() {
    context_.tell(Module::setup_engine, state(), done() ? 0 : work_->setup.triangle, 0);
    if (done()) return;
    if (cycles_left_ > 0) --cycles_left_;
    if (cycles_left_ > 0 || triangles_.full()) return;
    triangles_.push(work_);
    ++moved_;
    start_next();
  }

  ModuleState state() const {
    if (done()) return ModuleState::done;
    return cycles_left_ > 0 ? ModuleState::busy : ModuleState::stalled;
  }

  void start_next() {
    const auto work = std::make_shared<TriangleWork>();
    work_ = nullptr;
    cycles_left_ = 0;
    for (; work_ == nullptr && !next_.done(); next_.advance()) {
      if (context_.set_up(next_, *work, cycles_left_) == SetupOutcome::ready) work_ = work;
    }
  }

  FrameContext& context_;
  ClockedFifo<WorkHandle>& triangles_;
  TriangleOrder next_;
  std::uint64_t moved_ = 0;
  WorkHandle work_;
  Cycle cycles_left_ = 0;
};

}  // namespace phongpipe::by_clock
