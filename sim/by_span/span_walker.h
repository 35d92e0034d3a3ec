// span_walker, span by span: the rows of a triangle from the top down.
#pragma once

#include "sim/frame_context.h"

namespace phongpipe::by_span {

class SpanWalker : public sc_core::sc_module {
 public:
  SpanWalker(const sc_core::sc_module_name& name, FrameContext& context,
             TimestampedFifo<WorkHandle>& triangles, TimestampedFifo<Span>& spans)
      : sc_core::sc_module(name), context_(context), triangles_(triangles), spans_(spans) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(SpanWalker);

 private:
  void run() {
    const PipelineConfiguration& configuration = context_.configuration;
    Cycle free_from = 0;
    while (triangles_.wait_for_item()) {
      const Cycle taken = std::max(triangles_.front_seen_from(), free_from);
      const WorkHandle work = triangles_.front();
      triangles_.pop(taken);
      Cycle earliest = taken + configuration.walker_triangle_cycles;
      for (const RowSpan& row : work->rows) {
        context_.front_end.span_walker().start(work->setup, row, spans_.free_slot());
        const Cycle written = spans_.write(earliest);
        earliest = written + configuration.walker_row_cycles;
        free_from = written + 1;
      }
    }
    spans_.close();
  }

  FrameContext& context_;
  TimestampedFifo<WorkHandle>& triangles_;
  TimestampedFifo<Span>& spans_;
};

}  // namespace phongpipe::by_span
