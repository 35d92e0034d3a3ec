// Bounds of the errors of rounding: of a series' coefficients, and of the words of the exponent
// ROM.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/fixed/exponent_rom.h"

namespace phongpipe {

// Largest difference from the series with unrounded coefficients, in the series' units.
// `fraction_bits`: of the registers. `extent`: largest distance from the expansion point along x
// and along y, in pixels. `length`: largest length of a span, in pixels. Each of the six
// coefficients is off by half a unit of setup, and with Anchor::span each of the three numbers at a
// span's start by half a unit of the registers.
inline double rounding_bound(const FixedPointFormats& formats, int fraction_bits, double extent,
                             int length) {
  const int setup_bits = setup_fraction_bits(formats, fraction_bits);
  const double setup = std::ldexp(1 + extent * (2 + 3 * extent), -setup_bits - 1);
  if (formats.anchor == Anchor::triangle) return setup;
  const double n = length - 1;
  return setup + std::ldexp(1 + n + n * (n - 1) / 2, -fraction_bits - 1);
}

// The fewest fraction bits, from 0, with which rounding_bound() is at most `tolerance`, in the
// series' units; none if more than `most` were needed.
inline std::optional<int> fewest_fraction_bits(const FixedPointFormats& formats, double extent,
                                               int length, double tolerance, int most) {
  for (int bits = 0; bits <= most; ++bits) {
    if (rounding_bound(formats, bits, extent, length) <= tolerance) return bits;
  }
  return {};
}

// Largest difference of a ROM's words from specular · x^n, in output LSB, over x in [0, 1], for a
// specular colour of at most 1. A word is rounded by half its unit, in the bipartite layout its
// increment is, too; and words saturate.
inline double table_error_bound(const DatapathConfiguration& configuration, double specular,
                                double shininess) {
  const double unit = std::ldexp(1, kOutputBits - configuration.rom_data_bits);
  const double rounding = configuration.rom_layout == RomLayout::bipartite ? unit : unit / 2;
  // What the largest word lacks to a full highlight.
  const double missing = kOutputMax * specular - unit * ((1 << configuration.rom_data_bits) - 1);
  return kOutputMax * specular * ExponentRom::largest_error(configuration, shininess) +
         std::max(rounding, missing);
}

}  // namespace phongpipe
