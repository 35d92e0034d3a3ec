// Powers of the reference pictures.
#pragma once

#include <cmath>

namespace phongpipe {

// x^n for x from 0 to 1 and n of at least 0; 0^0 is 1. By squaring if n is a whole number of at
// most 1,024, which is several times as fast as std::pow. Relative error then: at most n·2^−53, for
// each multiplication adds half a unit in the last place and squaring doubles what its factor has.
inline double exact_power(double x, double n) {
  constexpr double kLargest = 1024;
  if (!(n <= kLargest) || n != std::floor(n)) return std::pow(x, n);
  double result = 1;
  for (auto bits = static_cast<unsigned>(n); bits > 0; bits >>= 1) {
    if (bits & 1) result *= x;
    x *= x;
  }
  return result;
}

}  // namespace phongpipe
