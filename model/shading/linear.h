// Functions that are linear in screen space: q(x, y) = A x + B y + C, x and y in pixels from the
// expansion point.
#pragma once

#include <array>

#include "model/shading/scalar.h"

namespace phongpipe {

template <typename Q>
struct Linear {
  Q a, b, c;  // per pixel along x, per pixel along y, at the origin
};

// Interpolates values at the corners of a triangle linearly. Corners are in pixels from the origin.
// The reciprocal of the determinant is det · rsqrt(det²)², because the setup engine has no divider.
template <typename T>
class Interpolator {
 public:
  Interpolator(const std::array<T, 3>& x, const std::array<T, 3>& y) : x0_(x[0]), y0_(y[0]) {
    const T x10 = x[1] - x[0], y10 = y[1] - y[0], x20 = x[2] - x[0], y20 = y[2] - y[0];
    const T determinant = x10 * y20 - x20 * y10;
    const T root = rsqrt(determinant * determinant);  // 1/|det|
    const T reciprocal = determinant * (root * root);
    x10_ = x10 * reciprocal;
    y10_ = y10 * reciprocal;
    x20_ = x20 * reciprocal;
    y20_ = y20 * reciprocal;
  }

  template <typename Q>
  Linear<Q> operator()(const Q& q0, const Q& q1, const Q& q2) const {
    const Q q10 = q1 - q0, q20 = q2 - q0;
    Linear<Q> result;
    result.a = q10 * y20_ - q20 * y10_;
    result.b = q20 * x10_ - q10 * x20_;
    result.c = q0 - result.a * x0_ - result.b * y0_;
    return result;
  }

  // The barycentric coordinates of corners 1 and 2.
  Linear<T> coordinate_1() const { return {y20_, -x20_, x20_ * y0_ - y20_ * x0_}; }
  Linear<T> coordinate_2() const { return {-y10_, x10_, y10_ * x0_ - x10_ * y0_}; }

 private:
  T x0_, y0_, x10_, y10_, x20_, y20_;
};

}  // namespace phongpipe
