// The coefficients of a quadratic as an array.
#pragma once

#include <array>

#include "model/shading/taylor.h"

namespace phongpipe {

using Six = std::array<double, 6>;  // T0 … T5

inline Six six(const Quadratic<double>& t) {
  return {t.t0, t.t1, t.t2, t.t3, t.t4, t.t5};
}

}  // namespace phongpipe
