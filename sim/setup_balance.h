// How many units the setup engine needs to keep up with the rest of the pipeline.
#pragma once

#include <optional>
#include <vector>

#include "sim/pipeline.h"

namespace phongpipe {

// Cycles of the setup engine for all triangles of a frame, one after the other.
std::int64_t setup_cycles(const std::vector<SetupUse>& uses, const PipelineConfiguration& units);

// The same pipeline with more units of the setup engine than any plan has operations at a time.
PipelineConfiguration with_most_units(PipelineConfiguration pipeline);

// The configuration with the fewest units of the setup engine, of all kinds together, that takes at
// most `cycles`; of several such, the one with the fewest multipliers, then 1/√ units, then powers.
// Latencies and intervals stay. Empty if no number of units does: triangles are set up one after
// the other, and none takes less than its longest chain of operations.
std::optional<PipelineConfiguration> fewest_setup_units(const std::vector<SetupUse>& uses,
                                                        const PipelineConfiguration& units,
                                                        std::int64_t cycles);

}  // namespace phongpipe
