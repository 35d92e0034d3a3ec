// span_walker, span by span: the rows of a triangle from the top down.
#pragma once

#include "sim/exact_path.h"
#include "sim/frame_context.h"

namespace phongpipe::by_span {

class SpanWalker : public sc_core::sc_module {
 public:
  SpanWalker(const sc_core::sc_module_name& name, FrameContext& context,
             TimestampedFifo<WorkHandle>& triangles, TimestampedFifo<Span>& spans)
      : sc_core::sc_module(name),
        context_(context),
        triangles_(triangles),
        spans_(spans),
        timing_(context) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(SpanWalker);

 private:
  void run() {
    Cycle free_from = 0;
    while (triangles_.wait_for_item()) {
      const Cycle taken = std::max(triangles_.front_seen_from(), free_from);
      const WorkHandle work = triangles_.front();
      triangles_.pop(taken);
      const SpanCycles cycles = timing_.take(*work);
      Cycle earliest = taken + cycles.first;
      for (const RowSpan& row : work->rows) {
        context_.front_end.span_walker().start(work->setup, row, spans_.free_slot());
        const Cycle written = spans_.write(earliest);
        earliest = written + cycles.next;
        free_from = written + 1;
      }
    }
    spans_.close();
  }

  FrameContext& context_;
  TimestampedFifo<WorkHandle>& triangles_;
  TimestampedFifo<Span>& spans_;
  SpanTiming timing_;
};

}  // namespace phongpipe::by_span
