// Interpolation of angles (Mortensen, OTMPHONG.DOC, 1995): the angle between normal and light is
// computed at the corners by the inverse cosine, stored in a byte and interpolated linearly; a
// table converts it to a cosine. The highlight is cosⁿ of the same angle, as if the eye were at the
// light. It is lost inside a triangle whose corners have (nearly) equal angles.
#pragma once

#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/lookup.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

constexpr int kRightAngle = 255;  // the byte of 90°, the largest angle of a lit facet

// The angle with this cosine as a byte, rounded to nearest; angles beyond 90° saturate.
double angle_byte(double cosine);
Recorded angle_byte(const Recorded& cosine);  // one read of a table

const LookupTable& cosine_table();  // addressed by the byte

template <typename T>
Linear<T> interpolated_angle(const ShadingInput<T>& in, const Interpolator<T>& interpolate,
                             const Vector3<T>& direction) {
  std::array<T, 3> angle;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<T>& n = in.normal[i];
    angle[i] = angle_byte(n.dot(direction) * rsqrt(n.dot(n)));
  }
  return interpolate(angle[0], angle[1], angle[2]);
}

// The source's own form, with one angle. Its palette holds colours instead of cosines, so the full
// model costs no more than the diffuse one.
template <typename T, Parts kParts>
class AngleInterpolation {
 public:
  explicit AngleInterpolation(const ShadingInput<T>& in)
      : angle_(interpolated_angle(in, interpolator(in), in.light)) {}

  void start_span(const T& x, const T& y) { step_ = start(angle_, x, y); }

  Reflection<T> next() {
    const T cosine = lookup(cosine_table(), step_.next());
    return {cosine, cosine, 1};
  }

 private:
  Linear<T> angle_;
  ForwardDifferences<T, 1> step_;
};

// With a second angle, between normal and halfway vector, which places Phong's highlight correctly.
// Not in the source.
template <typename T, Parts kParts>
class TwoAngleInterpolation {
 public:
  explicit TwoAngleInterpolation(const ShadingInput<T>& in) {
    const Interpolator<T> interpolate = interpolator(in);
    diffuse_ = interpolated_angle(in, interpolate, in.light);
    if constexpr (kParts == Parts::full) {
      highlight_ = interpolated_angle(in, interpolate, in.halfway);
    }
  }

  void start_span(const T& x, const T& y) {
    p_ = start(diffuse_, x, y);
    if constexpr (kParts == Parts::full) r_ = start(highlight_, x, y);
  }

  Reflection<T> next() {
    Reflection<T> result;
    result.diffuse = lookup(cosine_table(), p_.next());
    if constexpr (kParts == Parts::full) result.highlight = lookup(cosine_table(), r_.next());
    return result;
  }

 private:
  Linear<T> diffuse_, highlight_;
  ForwardDifferences<T, 1> p_, r_;
};

}  // namespace phongpipe
