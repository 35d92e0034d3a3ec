// How much the displayed power of a cosine minds the cosine's errors.
#pragma once

#include "model/shading/dataflow.h"
#include "model/shading/scalar.h"

namespace phongpipe {

// A comparison costs the setup engine a subtraction.
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

// 1 + slope·(1 − s). Where a quadratic misses s by d, s^n is missed by about n s^(n−1) d. The
// inverse of that sensitivity needs no table: s^−m = (1 + (1 − s)/s)^m is near (1 + m (1 − s)/8)^8
// as far as it matters, and is less extreme where highlights have died away, which does a fit good.
template <typename T>
class Fading {
 public:
  explicit Fading(const T& slope) : slope_(slope), at_zero_(T(1) + slope) {}
  T operator()(const T& cosine) const { return at_zero_ - slope_ * cosine; }

 private:
  T slope_, at_zero_;
};

}  // namespace phongpipe
