// Registers of the blocks of hw/. Each function has a file of its own.
#pragma once

#include <vector>

#include "sim/signals/datapath_signals.h"

namespace phongpipe {

// Of pixel_datapath.sv or pixel_datapath_serial.sv itself, span_control.sv and pixel_queue.sv.
std::vector<DatapathSignal> control_signals(const DatapathConfiguration& configuration);

// Of forward_differencer.sv, or of the words that digit_register.sv puts together.
std::vector<DatapathSignal> series_signals(const DatapathConfiguration& configuration);

// Of serial_differencer.sv, through which the digits of all series pass: stage 1 has the bits of a
// digit, stage 2 those of the next pixel's.
std::vector<DatapathSignal> digit_signals(const DatapathConfiguration& configuration);

// Of color_pipeline.sv, exponent_rom.sv, color_sum.sv and depth_cue.sv.
std::vector<DatapathSignal> color_signals(const DatapathConfiguration& configuration);

// Of pixel_datapath_wide.sv before its lanes, series_lanes.sv among them: stage -3 takes the input,
// -1 is before stage 0 of the lanes; l1_ to l3_ in RTL's names.
std::vector<DatapathSignal> lane_start_signals(const DatapathConfiguration& configuration);

}  // namespace phongpipe
