// How far the values of a series can be from those of the unrounded coefficients.
#pragma once

#include <cmath>

#include "model/fixed/setup_engine.h"

namespace phongpipe {

// In the series' units, whose registers have `fraction_bits`: over pixels up to `extent` from the
// expansion point along x and along y, in spans of up to `length`. Six coefficients off by half a
// unit of setup each, then with Anchor::span three numbers of a span's start off by half a unit of
// the registers.
inline double rounding_bound(const FixedPointFormats& formats, int fraction_bits, double extent,
                             int length) {
  const int setup_bits = setup_fraction_bits(formats, fraction_bits);
  const double setup = std::ldexp(1 + extent * (2 + 3 * extent), -setup_bits - 1);
  if (formats.anchor == Anchor::triangle) return setup;
  const double n = length - 1;
  return setup + std::ldexp(1 + n + n * (n - 1) / 2, -fraction_bits - 1);
}

}  // namespace phongpipe
