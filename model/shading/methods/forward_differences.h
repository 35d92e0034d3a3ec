// Polynomials over the pixels of a triangle and along a span. A polynomial of degree d is stepped
// with d additions a pixel, as Bishop & Weimer, Duff and Hast count it.
#pragma once

#include <array>
#include <cstddef>

#include "model/shading/quadratics/truncated_series.h"

namespace phongpipe {

template <typename T, std::size_t kDegree>
class ForwardDifferences {
 public:
  ForwardDifferences() = default;
  explicit ForwardDifferences(const std::array<T, kDegree + 1>& differences) : d_(differences) {}

  // Returns the value at this pixel, and steps one pixel to the right.
  T next() {
    const T value = d_[0];
    for (std::size_t i = 0; i < kDegree; ++i) d_[i] += d_[i + 1];
    return value;
  }

 private:
  std::array<T, kDegree + 1> d_;
};

// The differences at (x, y), for steps to the right.
template <typename T>
ForwardDifferences<T, 1> start(const Linear<T>& q, const T& x, const T& y) {
  return ForwardDifferences<T, 1>({q.a * x + q.b * y + q.c, q.a});
}

template <typename T>
ForwardDifferences<T, 2> start(const Quadratic<T>& q, const T& x, const T& y) {
  const T slope = q.t4 * y + q.t2, bend = q.t5 * x;
  const T value = (bend + slope) * x + (q.t3 * y + q.t1) * y + q.t0;
  return ForwardDifferences<T, 2>({value, twice(bend) + q.t5 + slope, twice(q.t5)});
}

// c0 + c1 t + … + c4 t⁴ from t = 0.
template <typename T>
ForwardDifferences<T, 4> start(const std::array<T, 5>& c) {
  return ForwardDifferences<T, 4>({c[0], c[1] + c[2] + c[3] + c[4],
                                   twice(c[2]) + T(6) * c[3] + T(14) * c[4],
                                   T(6) * c[3] + T(36) * c[4], T(24) * c[4]});
}

template <typename T>
Linear<T> dot(const Linear<Vector3<T>>& q, const Vector3<T>& v) {
  return {q.a.dot(v), q.b.dot(v), q.c.dot(v)};
}

template <typename T>
Linear<T> doubled(const Linear<T>& q) {
  return {twice(q.a), twice(q.b), twice(q.c)};
}

template <typename T>
Quadratic<T> doubled(const Quadratic<T>& q) {
  return {twice(q.t0), twice(q.t1), twice(q.t2), twice(q.t3), twice(q.t4), twice(q.t5)};
}

// q·q
template <typename T>
Quadratic<T> square(const Linear<Vector3<T>>& q) {
  return {q.c.dot(q.c), twice(q.b.dot(q.c)), twice(q.a.dot(q.c)),
          q.b.dot(q.b), twice(q.a.dot(q.b)), q.a.dot(q.a)};
}

template <typename T>
Quadratic<T> operator*(const Linear<T>& p, const Linear<T>& q) {
  return {p.c * q.c, p.b * q.c + p.c * q.b, p.a * q.c + p.c * q.a,
          p.b * q.b, p.a * q.b + p.b * q.a, p.a * q.a};
}

}  // namespace phongpipe
