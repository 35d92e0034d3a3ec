// Arithmetic on power series in x and y, truncated after second degree. An equation for values at a
// point, evaluated with these series, gives its Taylor series. The result of every operation is
// exact up to second degree.
#pragma once

#include "model/shading/quadratics/sensitivity.h"
#include "model/shading/quadratics/ten_point_fit.h"
#include "model/shading/taylor.h"

namespace phongpipe {

template <typename T>
Quadratic<T> operator+(const Quadratic<T>& p, const Quadratic<T>& q) {
  return {p.t0 + q.t0, p.t1 + q.t1, p.t2 + q.t2, p.t3 + q.t3, p.t4 + q.t4, p.t5 + q.t5};
}
template <typename T>
Quadratic<T> operator-(const Quadratic<T>& p, const Quadratic<T>& q) {
  return {p.t0 - q.t0, p.t1 - q.t1, p.t2 - q.t2, p.t3 - q.t3, p.t4 - q.t4, p.t5 - q.t5};
}
template <typename T>
Quadratic<T> operator+(Quadratic<T> p, const T& k) {
  p.t0 = p.t0 + k;
  return p;
}
template <typename T>
Quadratic<T> operator-(Quadratic<T> p, const T& k) {
  p.t0 = p.t0 - k;
  return p;
}
template <typename T>
Quadratic<T> operator*(const Quadratic<T>& p, const T& k) {
  return p.scaled(k);
}
template <typename T>
Quadratic<T> operator*(const Quadratic<T>& p, const Quadratic<T>& q) {
  return {p.t0 * q.t0,
          p.t0 * q.t1 + p.t1 * q.t0,
          p.t0 * q.t2 + p.t2 * q.t0,
          p.t0 * q.t3 + p.t1 * q.t1 + p.t3 * q.t0,
          p.t0 * q.t4 + p.t1 * q.t2 + p.t2 * q.t1 + p.t4 * q.t0,
          p.t0 * q.t5 + p.t2 * q.t2 + p.t5 * q.t0};
}
template <typename T>
Quadratic<T> twice(const Quadratic<T>& p) {
  return {twice(p.t0), twice(p.t1), twice(p.t2), twice(p.t3), twice(p.t4), twice(p.t5)};
}

// The series of f(x), from f, f' and f''/2 at the constant term of x.
template <typename T>
Quadratic<T> composed(const Quadratic<T>& x, const T& f, const T& slope, const T& curvature) {
  return {f,
          slope * x.t1,
          slope * x.t2,
          slope * x.t3 + curvature * (x.t1 * x.t1),
          slope * x.t4 + curvature * twice(x.t1 * x.t2),
          slope * x.t5 + curvature * (x.t2 * x.t2)};
}
template <typename T>
Quadratic<T> rsqrt(const Quadratic<T>& x) {
  const T root = rsqrt(x.t0), inverse = root * root;
  const T slope = -half(root * inverse);
  return composed(x, root, slope, slope * inverse * T(-0.75));
}
template <typename T>
Quadratic<T> reciprocal(const Quadratic<T>& x) {
  const T inverse = reciprocal(x.t0), slope = -(inverse * inverse);
  return composed(x, inverse, slope, -(slope * inverse));
}
// x^p; the zero series if the constant term of x is 0 or less.
template <typename T>
Quadratic<T> power(const Quadratic<T>& x, const T& p) {
  constexpr double kLeast = 1e-30;  // keeps 0 · 1/x from being NaN
  const T f = power(x.t0, p), inverse = reciprocal(maximum(x.t0, T(kLeast)));
  const T slope = p * f * inverse;
  return composed(x, f, slope, slope * inverse * half(p - T(1)));
}

// Clamps a value, or the constant term of a series. The other terms stay, because a clamped series
// only has to be finite.
template <typename T>
T at_least(const T& low, const T& x) {
  return maximum(low, x);
}
template <typename T>
Quadratic<T> at_least(const T& low, Quadratic<T> x) {
  x.t0 = maximum(low, x.t0);
  return x;
}

template <typename T>
T at_most(const T& high, const T& x) {
  return -maximum(-high, -x);
}
template <typename T>
Quadratic<T> at_most(const T& high, Quadratic<T> x) {
  x.t0 = at_most(high, x.t0);
  return x;
}

}  // namespace phongpipe
