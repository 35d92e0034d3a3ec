// Values of N·M / (|N||M|) at fixed points of a triangle. With N and M linear, N·N, N·M and M·M are
// quadratic forms of the barycentric coordinates: a few dot products at the corners determine them,
// and each point costs additions and a 1/√. Forms are evaluated at whole multiples of the
// coordinates, because the cosine does not depend on the lengths of N and M.
#pragma once

#include <array>

#include "model/shading/quadratics/barycentric.h"
#include "model/shading/quadratics/sensitivity.h"

namespace phongpipe {

// Sample points of the fits: 0–2 the corners, 3–5 the midpoints of the opposite edges, 6–8 half way
// from the centroid to the corners, 9 the centroid.
constexpr std::size_t kSixPoints = 6, kNinePoints = 9, kTenPoints = 10;

template <typename T, std::size_t points>
using Values = std::array<T, points>;

// Samples of forms of degree d at the fixed points, scaled by 1 at corners, 2^d at midpoints, 6^d
// at inner points and 3^d at the centroid. A sample computed from two corners is the same to the
// bit in either order, so triangles that share an edge agree on it.
template <typename T>
struct LinearForm {
  std::array<T, 3> corner;

  template <std::size_t points>
  Values<T, points> sampled() const {
    Values<T, points> result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = corner[i];
      result[3 + i] = corner[(i + 1) % 3] + corner[(i + 2) % 3];
    }
    if constexpr (points > kSixPoints) {
      const T centre = corner[0] + result[3];
      for (std::size_t i = 0; i < 3; ++i) {
        result[6 + i] = centre + (twice(corner[i]) + corner[i]);
      }
      if constexpr (points == kTenPoints) result[9] = centre;
    }
    return result;
  }
};

// Σ square[i] λi² + cross[i] λj λk
template <typename T>
struct QuadraticForm {
  std::array<T, 3> square, cross;

  template <std::size_t points>
  Values<T, points> sampled() const {
    Values<T, points> result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = square[i];
      result[3 + i] = square[(i + 1) % 3] + square[(i + 2) % 3] + cross[i];
    }
    if constexpr (points > kSixPoints) {
      // F(4, 1, 1) = F(1, 1, 1) + 15 square[0] + 3 (cross[1] + cross[2])
      const T centre = square[0] + result[3] + (cross[1] + cross[2]);
      for (std::size_t i = 0; i < 3; ++i) {
        const T crosses = cross[(i + 1) % 3] + cross[(i + 2) % 3];
        result[6 + i] = centre + (square[i] * T(15) + crosses * T(3));
      }
      if constexpr (points == kTenPoints) result[9] = centre;
    }
    return result;
  }
};

template <typename T>
QuadraticForm<T> squared_length(const std::array<Vector3<T>, 3>& n) {
  QuadraticForm<T> form;
  for (std::size_t i = 0; i < 3; ++i) {
    form.square[i] = n[i].dot(n[i]);
    form.cross[i] = twice(n[(i + 1) % 3].dot(n[(i + 2) % 3]));
  }
  return form;
}

template <typename T>
QuadraticForm<T> product(const std::array<Vector3<T>, 3>& n, const std::array<Vector3<T>, 3>& m) {
  QuadraticForm<T> form;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    form.square[i] = n[i].dot(m[i]);
    form.cross[i] = n[j].dot(m[k]) + n[k].dot(m[j]);
  }
  return form;
}

// The normals of a triangle at the fixed points.
template <typename T, std::size_t points>
class NormalSamples {
 public:
  explicit NormalSamples(const std::array<Vector3<T>, 3>& normal)
      : NormalSamples(normal, squared_length(normal).template sampled<points>()) {}
  // For a known |N|².
  NormalSamples(const std::array<Vector3<T>, 3>& normal, const QuadraticForm<T>& squared_length)
      : NormalSamples(normal, squared_length.template sampled<points>()) {}
  // For vectors that may vanish, whose forms are then only rounding errors: squared lengths are
  // raised to at least `least` times the sum of those at the corners.
  NormalSamples(const std::array<Vector3<T>, 3>& normal, double least)
      : NormalSamples(normal, not_below(least, squared_length(normal).template sampled<points>())) {
  }

  // |N|
  Values<T, points> lengths() const {
    Values<T, points> result;
    for (std::size_t i = 0; i < points; ++i) {
      const T multiple = squared_length_[i] * inverse_length_[i];
      result[i] = i < 3   ? multiple
                  : i < 6 ? half(multiple)
                          : multiple * T(i < 9 ? 1.0 / 6 : 1.0 / 3);
    }
    return result;
  }

  // N·M / |N| at the first points, for a constant unit M.
  template <std::size_t first = points>
  Values<T, first> cosines(const Vector3<T>& m) const {
    const LinearForm<T> form = {{normal_[0].dot(m), normal_[1].dot(m), normal_[2].dot(m)}};
    return times(form.template sampled<first>(), inverse_length_);
  }

  // N·M / (|N||M|) at the first points, for M linear between the corners.
  template <std::size_t first = points>
  Values<T, first> cosines(const std::array<Vector3<T>, 3>& m) const {
    return cosines<first>(NormalSamples<T, first>(m));
  }
  template <std::size_t first = points, std::size_t more>
  Values<T, first> cosines(const NormalSamples<T, more>& m) const {
    return times(times(product(normal_, m.normal_).template sampled<first>(), inverse_length_),
                 m.inverse_length_);
  }

 private:
  template <typename, std::size_t>
  friend class NormalSamples;

  NormalSamples(const std::array<Vector3<T>, 3>& normal, const Values<T, points>& squared_length)
      : normal_(normal),
        squared_length_(squared_length),
        inverse_length_(inverse_roots(squared_length)) {}

  static Values<T, points> not_below(double least, Values<T, points> v) {
    const T low = (v[0] + v[1] + v[2]) * T(least);
    for (T& x : v) x = maximum(low, x);
    return v;
  }
  template <std::size_t count>
  static Values<T, count> inverse_roots(Values<T, count> v) {
    for (T& x : v) x = rsqrt(x);
    return v;
  }
  template <std::size_t count, std::size_t more>
  static Values<T, count> times(Values<T, count> v, const Values<T, more>& factors) {
    for (std::size_t i = 0; i < count; ++i) v[i] = v[i] * factors[i];
    return v;
  }

  std::array<Vector3<T>, 3> normal_;
  Values<T, points> squared_length_, inverse_length_;
};

}  // namespace phongpipe
