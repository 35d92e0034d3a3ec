// Time of the setup engine: a recorded dataflow, scheduled on a given number of units.
#pragma once

#include <deque>

#include "model/shading/dataflow.h"
#include "model/shading/triangle_setup.h"
#include "sim/pipeline_configuration.h"

namespace phongpipe {

// The operations of setup_triangle for a plan, recorded from the template that also computes the
// values.
Dataflow record_setup(const SeriesPlan& plan);

// Cycles from the first operand to the last result under list scheduling: in each cycle, of the
// operations whose operands are available, those on the longest remaining path start first.
int schedule_cycles(const Dataflow& dataflow, const PipelineConfiguration& units);

// The cost of each plan, which is scheduled when it first occurs.
class SetupTimes {
 public:
  explicit SetupTimes(const PipelineConfiguration& units) : units_(&units) {}

  struct Cost {
    SeriesPlan plan;
    OperationCounts operations;
    int cycles = 0;
  };
  const Cost& of(const SeriesPlan& plan);

 private:
  const PipelineConfiguration* units_;
  std::deque<Cost> known_;  // few; a deque, because references to elements are handed out
};

}  // namespace phongpipe
