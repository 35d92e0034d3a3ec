// The operations the formulas need beside + − ×, for real numbers. A scalar that records or counts
// overloads the same names.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace phongpipe {

// Unqualified, so that the overloads of other scalars are found; a change of exponent costs no
// unit.
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
