// From operations counted to time.
#pragma once

#include "model/shading/dataflow.h"
#include "sim/pipeline_configuration.h"

namespace phongpipe {

// Clocks in which the given units can start these operations over and over, each unit always fed:
// the busiest kind decides. There is no divider and no root: x/√y is an rsqrt and a multiplication,
// a division alone an rsqrt and two, a root alone an rsqrt and one. One memory port.
double clocks(const OperationCounts& counts, const PipelineConfiguration& units);

// Operations one after the other as Bishop & Weimer count them: additions, multiplications and
// memory references 1 each, 1/√x and what is made of it 10; so are powers.
double sequential_operations(const OperationCounts& counts);

}  // namespace phongpipe
