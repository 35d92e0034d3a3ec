// Time of the setup engine: a recorded dataflow, scheduled on a given number of units.
#pragma once

#include <deque>
#include <map>
#include <vector>

#include "model/fixed/exact_path.h"
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
    std::uint64_t triangles = 0;  // that were set up so; counted by the caller
  };
  Cost& of(const SeriesPlan& plan);
  const std::deque<Cost>& known() const { return known_; }

 private:
  const PipelineConfiguration* units_;
  std::deque<Cost> known_;  // few; a deque, because references to elements are handed out
};

// The cost of a pixel of exact_path, which has exact_path.adders and multipliers, and as many units
// for 1/√ and powers as the setup engine.
class ExactPathTimes {
 public:
  explicit ExactPathTimes(const PipelineConfiguration& configuration);

  struct Cost {
    OperationCounts operations;  // of a pixel
    int latency_cycles = 0;      // from its vectors to its colour
    int interval_cycles = 0;     // from one pixel to the next: of the kind of unit with most to do
  };
  // `index`: of the material in the frame's geometry.
  const Cost& of(const FrameSetup& frame, const Material& material, std::uint32_t index);

 private:
  PipelineConfiguration units_;
  std::map<std::uint32_t, Cost> known_;  // by material
};

// The operations of one pixel of a material.
Dataflow record_exact_pixel(const std::vector<ExactLight<double>>& lights, bool depth_cue,
                            int channels);

}  // namespace phongpipe
