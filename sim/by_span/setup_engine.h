// setup_engine, span by span: one triangle after the other, each for the cycles of its schedule.
#pragma once

#include "sim/frame_context.h"

namespace phongpipe::by_span {

class SetupEngine : public sc_core::sc_module {
 public:
  SetupEngine(const sc_core::sc_module_name& name, FrameContext& context,
              TimestampedFifo<WorkHandle>& triangles)
      : sc_core::sc_module(name), context_(context), triangles_(triangles) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(SetupEngine);

 private:
  void run() {
    Cycle written = -1, busy = 0;
    auto work = std::make_shared<TriangleWork>();
    for (TriangleOrder next(context_.front_end); !next.done(); next.advance()) {
      const SetupOutcome outcome = context_.set_up(next, *work, busy);
      if (outcome != SetupOutcome::ready) continue;
      written = triangles_.write(std::move(work), written + busy);
      work = std::make_shared<TriangleWork>();
      busy = 0;
    }
    triangles_.close();
  }

  FrameContext& context_;
  TimestampedFifo<WorkHandle>& triangles_;
};

}  // namespace phongpipe::by_span
