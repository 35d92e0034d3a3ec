// Registers of hw/serial_differencer.sv, through which the digits of all series pass.
#pragma once

#include "sim/datapath_registers.h"

namespace phongpipe {

// Stage 1 has the bits of a digit, stage 2 those of the next pixel's, as RTL's names say.
std::vector<DatapathSignal> digit_signals(const DatapathConfiguration& configuration);

}  // namespace phongpipe
