// Converts operation counts to time.
#pragma once

#include "model/shading/dataflow.h"
#include "sim/pipeline_configuration.h"

namespace phongpipe {

// Quotients by a root, divisions alone and roots alone.
struct Roots {
  std::size_t pairs = 0, divisions = 0, roots = 0;
};
Roots roots_of(const OperationCounts& counts);

// Clocks per repetition if the given units repeat these operations and are always fed: the busiest
// kind of unit decides. There is one memory port, and no unit for division or roots: x/√y takes an
// rsqrt and a multiplication, a division alone an rsqrt and two multiplications, a root alone an
// rsqrt and one.
double clocks(const OperationCounts& counts, const PipelineConfiguration& units);

// Time of operations executed one after the other, as Bishop & Weimer count: 1 for an addition,
// multiplication or memory reference; 10 for 1/√x, a power, or a division or root alone; 11 for
// x/√y.
double sequential_operations(const OperationCounts& counts);

}  // namespace phongpipe
