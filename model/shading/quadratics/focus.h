// The part of a triangle that contains its highlight: a smaller, similar triangle, moved towards
// the brightest point and shrunk with the highlight. Fixed sample points in it see even a small
// highlight.
#pragma once

#include "model/shading/quadratics/sensitivity.h"
#include "model/shading/quadratics/ten_point_fit.h"

namespace phongpipe {

template <typename T>
class Focus {
 public:
  // Centres the smaller triangle on the highlight. `cosines`: of the highlight over the whole
  // triangle.
  Focus(const Values<T, kSixPoints>& cosines, const T& sharpness) {
    const Fading<T> fading(sharpness * T(kCentring / 4));
    Values<T, kSixPoints> w;  // the highlight's intensity, roughly
    for (std::size_t i = 0; i < kSixPoints; ++i) w[i] = eighth_power(rsqrt(fading(cosines[i])));
    std::array<T, 3> sums;
    for (std::size_t i = 0; i < 3; ++i) {
      sums[i] = w[i] + half(w[3 + (i + 1) % 3] + w[3 + (i + 2) % 3]);
    }
    const T inverse = reciprocal(sums[0] + sums[1] + sums[2]);
    for (std::size_t i = 0; i < 3; ++i) centre_[i] = sums[i] * inverse;
  }

  // Shrinks until the highlight fades by a fixed factor between the centre and the corners.
  void shrink(const T& cosine_at_centre, const Values<T, kSixPoints>& cosines, const T& sharpness) {
    const T corners = (cosines[0] + cosines[1] + cosines[2]) * T(1.0 / 3);
    const T drop = maximum(T(0), cosine_at_centre - corners);
    const T x = T(1) + drop * (sharpness * T(1 / kFading));
    scale_ = rsqrt(x);
    inverse_scale_ = x * scale_;
  }

  Vector3<T> at_centre(const std::array<Vector3<T>, 3>& q) const {
    return q[0] * centre_[0] + q[1] * centre_[1] + q[2] * centre_[2];
  }

  const T& coordinate_of(std::size_t corner) const { return centre_[corner]; }

  // A vector that is linear over the whole triangle, at the corners of the smaller one.
  std::array<Vector3<T>, 3> corners(const std::array<Vector3<T>, 3>& q,
                                    const Vector3<T>& at_centre) const {
    std::array<Vector3<T>, 3> result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = at_centre + (q[i] - at_centre) * scale_;
    return result;
  }

  // The smaller triangle's barycentric coordinate of corner i, from the whole triangle's.
  Linear<T> coordinate(const Linear<T>& whole, std::size_t i) const {
    return {whole.a * inverse_scale_, whole.b * inverse_scale_,
            centre_[i] + (whole.c - centre_[i]) * inverse_scale_};
  }

 private:
  // Chosen for the smallest error relative to that of the best quadratics.
  static constexpr double kCentring = 1.3;
  static constexpr double kFading = 6.2;

  std::array<T, 3> centre_;  // in barycentric coordinates
  T scale_, inverse_scale_;
};

}  // namespace phongpipe
