#include "testbench/synthesis/unit_targets.h"

#include "model/fixed/constants.h"
#include "model/fixed/datapath_configuration.h"
#include "model/fixed/units.h"

namespace phongpipe {

std::vector<UnitTarget> unit_targets() {
  constexpr int kWidth = 16;
  const RsqrtFormat root;
  const DatapathConfiguration datapath;  // with the paper's table of 1,024 powers
  const int word = datapath.rom_data_bits, address = datapath.rom_address_bits;
  return {
      {"add",
       2,
       {"unit_adder", {{"WIDTH", kWidth}}, {{"a", kWidth}, {"b", kWidth}}, {{"sum", kWidth}}, {}},
       "units"},
      {"multiply",
       kWidth,
       {"unit_multiplier",
        {{"A_BITS", kWidth}, {"B_BITS", kWidth}},
        {{"a", kWidth}, {"b", kWidth}},
        {{"product", 2 * kWidth}},
        {}},
       "units"},
      {"divide",
       kWidth,
       {"unit_divider",
        {{"WIDTH", kWidth}},
        {{"dividend", kWidth}, {"divisor", kWidth}},
        {{"quotient", kWidth}},
        {}},
       "units"},
      {"rsqrt",
       root.delta_bits() + 4,
       {"unit_rsqrt",
        {{"WIDTH", root.width}, {"TABLE_BITS", root.table_bits}, {"SLOPE_BITS", root.slope_bits}},
        {{"x", root.width},
         {"table_write", 1},
         {"table_address", root.table_bits},
         {"table_data", root.width + root.slope_bits}},
        {{"root", root.width}},
        {}},
       "units"},
      {"power",
       4,
       {"exponent_rom",
        {{"VALUE_WIDTH", datapath.specular_width()},
         {"GUARD_BITS", datapath.specular_guard_bits},
         {"ADDRESS_BITS", address},
         {"WORD_BITS", word},
         {"LAYOUT", static_cast<int>(datapath.rom_layout)},
         {"OCTAVES", datapath.rom_octaves}},
        {{"s4_v", datapath.specular_width()},
         {"write", 1},
         {"write_address", address},
         {"write_word", word}},
        {{"s8_word", word}, {"s8_increment", word}},
        {}},
       "."}};
}

}  // namespace phongpipe
