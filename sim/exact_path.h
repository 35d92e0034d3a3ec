// exact_path: the unit that shades pixels one by one, where no quadratic is good enough. It stands
// beside span_walker, which passes it the triangles it is for, and sends its pixels on as spans of
// one pixel. Values: model/fixed/exact_path.h; operations: model/shading/exact_reflection.h.
#pragma once

#include "sim/frame_context.h"

namespace phongpipe {

// Cycles of span_walker before the first span of a triangle, and from one span to the next.
struct SpanCycles {
  Cycle first = 0, next = 0;
};

class ExactPath : public sc_core::sc_module {
 public:
  ExactPath(const sc_core::sc_module_name& name, FrameContext& context)
      : sc_core::sc_module(name), context_(context), times_(context.configuration) {}

  // Counts the operations and cycles of the triangle, all of whose rows must be exact.
  SpanCycles take(const TriangleWork& work) {
    const FrameSetup& frame = context_.frame;
    const auto& materials = frame.geometry->materials;
    const std::uint32_t material = frame.geometry->triangles[work.setup.triangle].material;
    const ExactPathTimes::Cost& cost = times_.of(frame, materials[material], material);
    const auto pixels = static_cast<Cycle>(work.rows.size());
    context_.result.exact_path_cycles += cost.latency_cycles + pixels * cost.interval_cycles;
    context_.result.exact_path_operations =
        context_.result.exact_path_operations + work.rows.size() * cost.operations;
    return {context_.configuration.walker_triangle_cycles + cost.latency_cycles,
            cost.interval_cycles};
  }

 private:
  FrameContext& context_;
  ExactPathTimes times_;
};

// exact_path as a part of span_walker: elaborated if the frame certifies its errors.
class SpanTiming {
 public:
  explicit SpanTiming(FrameContext& context) : context_(context) {
    if (context.frame.certificates) {
      exact_path_ = std::make_unique<ExactPath>("exact_path", context);
    }
  }
  SpanCycles take(const TriangleWork& work) const {
    if (work.rows.front().is_exact()) return exact_path_->take(work);
    const SpanCycles cycles = {context_.configuration.walker_triangle_cycles,
                               context_.configuration.walker_row_cycles};
    context_.result.walker_cycles +=
        cycles.first + static_cast<Cycle>(work.rows.size() - 1) * cycles.next + 1;
    return cycles;
  }

 private:
  FrameContext& context_;
  std::unique_ptr<ExactPath> exact_path_;
};

}  // namespace phongpipe
