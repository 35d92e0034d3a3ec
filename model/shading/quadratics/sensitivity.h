// Sensitivity of the displayed power of a cosine to errors of the cosine.
#pragma once

#include "model/shading/dataflow.h"
#include "model/shading/scalar.h"

namespace phongpipe {

// A maximum costs the setup engine one subtraction.
inline double maximum(double a, double b) {
  return a > b ? a : b;
}
inline Recorded maximum(const Recorded& a, const Recorded& b) {
  return a - b;
}

template <typename T>
T eighth_power(const T& x) {
  const T square = x * x, fourth = square * square;
  return fourth * fourth;
}

// 1 + slope·(1 − s). An error d of a cosine s changes s^n by about n s^(n−1) d. The inverse of that
// sensitivity needs no table: s^−m = (1 + (1 − s)/s)^m is close to (1 + m (1 − s)/8)^8 while s is
// close to 1. Where highlights have faded the latter is less extreme, which improves the fit.
template <typename T>
class Fading {
 public:
  explicit Fading(const T& slope) : slope_(slope), at_zero_(T(1) + slope) {}
  T operator()(const T& cosine) const { return at_zero_ - slope_ * cosine; }

 private:
  T slope_, at_zero_;
};

}  // namespace phongpipe
