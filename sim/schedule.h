// The setup engine's time: a recorded dataflow on a given number of units.
#pragma once

#include <deque>

#include "model/shading/dataflow.h"
#include "model/shading/triangle_setup.h"
#include "sim/pipeline_configuration.h"

namespace phongpipe {

// The operations of setup_triangle for a plan, recorded from the very template that computes them.
Dataflow record_setup(const SeriesPlan& plan);

// Cycles from the first operand to the last result under list scheduling: each cycle, of the
// operations whose operands are there, those on the longest remaining path are started first.
int schedule_cycles(const Dataflow& dataflow, const PipelineConfiguration& units);

// What each plan costs, scheduled when it is first met.
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
  std::deque<Cost> known_;  // a few; those given away stay where they are
};

}  // namespace phongpipe
