// The units of hw/units/ as they are synthesised for the technology cards: words of 16 bits.
#pragma once

#include <string>
#include <vector>

#include "testbench/synthesis/place_and_route.h"

namespace phongpipe {

struct UnitTarget {
  std::string operation;  // as MeasuredUnit has it
  int latency_cycles = 0;
  SynthesisTarget target;
  std::string folder;  // of its RTL, in the folder of the RTL
};

std::vector<UnitTarget> unit_targets();

}  // namespace phongpipe
