// Values of N·M / (|N||M|) at fixed points of a triangle. With N and M linear, N·N, N·M and M·M are
// quadratic forms of the barycentric coordinates: a few dot products at the corners give them
// everywhere, and a point costs additions and a 1/√. Points are taken at whole multiples of their
// coordinates, as the cosine does not depend on the lengths.
#pragma once

#include <array>

#include "model/shading/quadratics/barycentric.h"

namespace phongpipe {

// Values at corners, middles of the edges, centroid, and half way from there to the corners.
template <typename T>
struct TenValues {
  SixValues<T> outer;
  std::array<T, 3> inner;
  T centre;
};

// F(λ) = Σ square[i] λi² + cross[i] λj λk. What is computed from two corners is the same to the bit
// whichever comes first: triangles that share an edge agree on it.
template <typename T>
struct QuadraticForm {
  std::array<T, 3> square, cross;

  SixValues<T> at_six() const {
    SixValues<T> result = {square, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = next_corner(i), k = next_corner(j);
      result.middle[i] = square[j] + square[k] + cross[i];  // 4 F
    }
    return result;
  }

  TenValues<T> at_ten() const {
    TenValues<T> result = {at_six(), {}, {}};
    const T squares = square[0] + square[1] + square[2];
    result.centre = squares + (cross[0] + cross[1] + cross[2]);  // 9 F
    for (std::size_t i = 0; i < 3; ++i) {
      // 36 F(4, 1, 1) = F(1, 1, 1) + 15 square + 3 (cross + cross)
      const std::size_t j = next_corner(i), k = next_corner(j);
      const T three = square[i] + (cross[j] + cross[k]) * T(0.2);
      result.inner[i] = result.centre + three * T(15);
    }
    return result;
  }
};

template <typename T>
QuadraticForm<T> squared_length(const std::array<Vector3<T>, 3>& n) {
  QuadraticForm<T> form;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next_corner(i), k = next_corner(j);
    form.square[i] = n[i].dot(n[i]);
    form.cross[i] = twice(n[j].dot(n[k]));
  }
  return form;
}

template <typename T>
QuadraticForm<T> product(const std::array<Vector3<T>, 3>& n, const std::array<Vector3<T>, 3>& m) {
  QuadraticForm<T> form;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = next_corner(i), k = next_corner(j);
    form.square[i] = n[i].dot(m[i]);
    form.cross[i] = n[j].dot(m[k]) + n[k].dot(m[j]);
  }
  return form;
}

}  // namespace phongpipe
