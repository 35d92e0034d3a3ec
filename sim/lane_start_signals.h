// Registers of hw/pixel_datapath_wide.sv before its lanes, hw/series_lanes.sv among them.
#pragma once

#include "sim/datapath_registers.h"

namespace phongpipe {

// Stage -3 takes the input, -1 is before stage 0 of the lanes: l1_ to l3_ in RTL's names.
std::vector<DatapathSignal> lane_start_signals(const DatapathConfiguration& configuration);

}  // namespace phongpipe
