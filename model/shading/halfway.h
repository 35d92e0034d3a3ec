// The paper's halfway vector for an eye at a finite distance: H = E + L, with E interpolated
// between unit vectors, so that H is linear over the triangle.
#pragma once

#include <array>

#include "model/shading/scalar.h"

namespace phongpipe {

// `eye`: surface → eye at each corner, of any length; `to_light`: unit.
template <typename T>
std::array<Vector3<T>, 3> halfway_at_corners(const std::array<Vector3<T>, 3>& eye,
                                             const Vector3<T>& to_light) {
  std::array<Vector3<T>, 3> halfway;
  for (std::size_t i = 0; i < 3; ++i) {
    halfway[i] = eye[i] * rsqrt(eye[i].dot(eye[i])) + to_light;
  }
  return halfway;
}

}  // namespace phongpipe
