// Bound of the rounding error of a series.
#pragma once

#include <cmath>

#include "model/fixed/setup_engine.h"

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

}  // namespace phongpipe
