// Hardware that shades a pixel a clock by a method: a pipelined unit of hw/units/ for each of the
// operations of a pixel.
#pragma once

#include <optional>

#include "model/shading/dataflow.h"
#include "testbench/hardware/technology.h"

namespace phongpipe {

// Registers in which values wait for others, and control, are not counted.
struct UnitHardware {
  int luts = 0, registers = 0, block_rams = 0;
  double clock_ns = 0;  // of the slowest unit; so many ns a pixel

  double lut_ns() const { return luts * clock_ns; }  // area × time of a pixel
};

// x/√y and √x take a unit for 1/√ and a multiplier; powers and table reads an exponent ROM each.
// Empty if the card has no units.
std::optional<UnitHardware> unit_hardware(const OperationCounts& pixel,
                                          const Technology& technology);

}  // namespace phongpipe
