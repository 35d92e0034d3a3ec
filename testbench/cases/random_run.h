// Random runs for regressions: a random scene, random settings of the hardware, random
// back-pressure.
#pragma once

#include <cstdint>

#include "testbench/cosim/run.h"

namespace phongpipe {

// Run number `index` of a seed: always the same. Settings are often at an end of their range. Time
// is not budgeted, and the technology is the card that has a clock for everything.
RunRequest random_run(std::uint64_t seed, std::uint64_t index);

}  // namespace phongpipe
