// Operations that the formulas need besides + − ×, for double. Other scalars, such as Recorded,
// overload the same names.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace phongpipe {

// Call these unqualified, so that the overloads for other scalars are found. half and twice change
// the exponent only and need no unit.
inline double rsqrt(double x) {
  return 1 / std::sqrt(x);
}
// x^p, 0 below 0.
inline double power(double x, double p) {
  return std::pow(x > 0 ? x : 0, p);
}
inline double half(double x) {
  return 0.5 * x;
}
inline double twice(double x) {
  return 2 * x;
}

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

}  // namespace phongpipe
