// span_walker, clock by clock.
#pragma once

#include "sim/clocked_fifo.h"
#include "sim/exact_path.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class SpanWalker : public sc_core::sc_module {
 public:
  SpanWalker(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
             ClockedFifo<WorkHandle>& triangles, ClockedFifo<Span>& spans)
      : sc_core::sc_module(name),
        context_(context),
        triangles_(triangles),
        spans_(spans),
        timing_(context) {
    SC_METHOD(clock);
    sensitive << clk.posedge_event();
    dont_initialize();
  }
  SC_HAS_PROCESS(SpanWalker);

  bool idle() const { return work_ == nullptr; }
  std::uint64_t moved() const { return written_; }

 private:
  void clock() {
    tell_state();
    if (idle()) {
      if (triangles_.empty()) return;
      work_ = triangles_.front();
      triangles_.pop();
      row_ = 0;
      cycles_ = timing_.take(*work_);
      cycles_left_ = cycles_.first;
      return;
    }
    if (cycles_left_ > 0) --cycles_left_;
    if (cycles_left_ > 0 || spans_.full()) return;
    spans_.push(context_.front_end.span_walker().start(work_->setup, work_->rows[row_]));
    ++written_;
    cycles_left_ = cycles_.next;
    if (++row_ == work_->rows.size()) work_ = nullptr;
  }

  void tell_state() const {
    const bool takes = idle() && !triangles_.empty();
    const ModuleState state = takes || (!idle() && cycles_left_ > 0) ? ModuleState::busy
                              : idle()                               ? ModuleState::waiting
                                                                     : ModuleState::stalled;
    const TriangleWork* const work = takes ? triangles_.front().get() : work_.get();
    context_.tell(Module::span_walker, state, work == nullptr ? 0 : work->setup.triangle,
                  triangles_.size());
  }

  FrameContext& context_;
  ClockedFifo<WorkHandle>& triangles_;
  ClockedFifo<Span>& spans_;
  WorkHandle work_;
  std::size_t row_ = 0;
  SpanTiming timing_;
  SpanCycles cycles_;  // of the triangle
  Cycle cycles_left_ = 0;
  std::uint64_t written_ = 0;
};

}  // namespace phongpipe::by_clock
