// The table of the datapath's registers: block, name, stage, format, and where RTL and SystemC have
// them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/datapath_registers.h"

namespace phongpipe {

// Where lane k of a wide datapath is, below pixel_datapath.
std::string lane_scope(int k);

// Unit of what lanes 1 and up of a wide datapath have in place of x, see hw/pixel_datapath_wide.sv.
constexpr const char* kMinusPixelsToCome = "pixels of the lane still to come, negated";

// When a register has a meaning: in every clock, as those of the control; or while a pixel is in
// its stage, and it is the first of its span or not.
enum class Meaning { always, every_pixel, first_pixel, further_pixels };

// A register of pixel_datapath: where it is in RTL and here, and how to read it. Waveforms, views,
// comparisons of registers and the life of a pixel are made from these descriptions.
struct DatapathSignal {
  std::string
      scope;  // the block below pixel_datapath, as "color.specular.rom"; empty: pixel_datapath
  std::string name;  // as "s5_address"
  int stage = 0;     // whose pixel it belongs to; negative: before the lanes
  Meaning meaning = Meaning::every_pixel;
  bool of_digit = false;  // of the serial datapath: changes while its pixel is in the stage
  int width = 1;          // bits
  int fraction_bits = 0;  // of them, below one unit
  bool is_signed = false;
  // Of the value: "LSB", "address" (of the table), kMinusPixelsToCome, or empty for a plain number.
  std::string unit;
  int rtl_lsb = 0;     // the bit of the RTL's signal that the register begins at
  std::string packed;  // name of the RTL's signal, if it is packed with others
  std::function<std::int64_t(const DatapathRegisters&)> value;

  // Whether it has a meaning in this clock.
  bool counts(const DatapathRegisters& registers) const;
  // "pixel_datapath.color.specular.rom".
  std::string block() const;
  std::string full_name() const { return block() + "." + name; }
  // In units.
  double real(std::int64_t bits) const;
};

// The registers of a configuration, stage by stage. Left out are memories, registers of the tables'
// write port, and those at the output, which are compared as ports.
std::vector<DatapathSignal> datapath_signals(const DatapathConfiguration& configuration);

}  // namespace phongpipe
