// Point light, spotlight and fixed viewpoint by reflection (Hast, Barrera & Bengtsson 2001,
// sections 5 and 6). The vector W to the light or to the eye is linear over the triangle; a unit
// vector s is mirrored about H = s + W, as reflection shading does for the normal:
//     W' = 2 (H·s)/(H·H) H − s                                                (36, 38)
// H depends on the length of W. The source leaves W in scene units; here W is divided by its length
// at the triangle's origin first (see ERRATA). W' = U/(H·H) with U quadratic along the span, so
// every cosine is a quotient of polynomials. They have fourth degree in the cosine between normal
// and W.
#pragma once

#include "model/shading/methods/reflection_shading.h"

namespace phongpipe {

// Along a span: the mirrored vector is (u[0] + u[1] t + u[2] t²) / (q[0] + q[1] t + q[2] t²).
template <typename T>
struct MirroredSpan {
  std::array<Vector3<T>, 3> u;
  std::array<T, 3> q;

  // Mirrors s about h, from (x, y) to the right.
  MirroredSpan(const Linear<Vector3<T>>& h, const Vector3<T>& s, const T& x, const T& y) {
    const Vector3<T> k = h.a, m = h.a * x + h.b * y + h.c;
    const T ks = twice(k.dot(s)), ms = twice(m.dot(s));
    q = {m.dot(m), twice(k.dot(m)), k.dot(k)};
    u = {m * ms - s * q[0], k * ms + m * ks - s * q[1], k * ks - s * q[2]};
  }

  ForwardDifferences<T, 2> along(const Vector3<T>& v) const {
    return along_quadratic(u[0].dot(v), u[1].dot(v), u[2].dot(v));
  }
  ForwardDifferences<T, 2> squared() const { return along_quadratic(q[0], q[1], q[2]); }
  ForwardDifferences<T, 4> along(const MirroredSpan& other) const {
    const auto& v = other.u;
    return start<T>({u[0].dot(v[0]), u[0].dot(v[1]) + u[1].dot(v[0]),
                     u[0].dot(v[2]) + u[1].dot(v[1]) + u[2].dot(v[0]),
                     u[1].dot(v[2]) + u[2].dot(v[1]), u[2].dot(v[2])});
  }

 private:
  static ForwardDifferences<T, 2> along_quadratic(const T& c0, const T& c1, const T& c2) {
    return ForwardDifferences<T, 2>({c0, c1 + c2, twice(c2)});
  }
};

enum class VaryingVector { point_light, spotlight, viewpoint };

template <typename T, Parts kParts, VaryingVector kVarying>
class ReflectedVectors {
  static constexpr bool kLightVaries = kVarying != VaryingVector::viewpoint;
  // With a constant light, diffuse reflection needs no W.
  static constexpr bool kNeedsVarying = kLightVaries || kParts == Parts::full;
  static constexpr bool kSpot = kVarying == VaryingVector::spotlight;

 public:
  explicit ReflectedVectors(const ShadingInput<T>& in)
      : face_(in.face), fixed_(kLightVaries ? in.viewer : in.light) {
    const Interpolator<T> interpolate = interpolator(in);
    normal_half_ = interpolate(in.normal[0], in.normal[1], in.normal[2]);
    normal_half_.c += face_;
    if constexpr (kNeedsVarying) {
      const auto& w = kLightVaries ? in.to_light : in.eye;
      half_ = interpolate(w[0], w[1], w[2]);
      const T scale = rsqrt(half_.c.dot(half_.c));
      half_ = {half_.a * scale, half_.b * scale, half_.c * scale};
      // s is the axis of the spotlight or of the view; for a point light, the direction at the
      // origin.
      axis_ = kSpot ? in.axis : kLightVaries ? half_.c : in.viewer;
      half_.c += axis_;
    }
  }

  void start_span(const T& x, const T& y) {
    const MirroredSpan<T> normal(normal_half_, face_, x, y);
    normal_q_ = normal.squared();
    if constexpr (kNeedsVarying) {
      const MirroredSpan<T> varying(half_, axis_, x, y);
      q_ = varying.squared();
      normal_varying_ = normal.along(varying);
      if constexpr (kParts == Parts::full) varying_fixed_ = varying.along(fixed_);
      if constexpr (kSpot) spot_ = varying.along(axis_);
    }
    if constexpr (kParts == Parts::full || !kLightVaries) normal_fixed_ = normal.along(fixed_);
  }

  Reflection<T> next() {
    Reflection<T> result;
    if constexpr (!kNeedsVarying) {
      result.diffuse = normal_fixed_.next() / normal_q_.next();
      return result;
    }
    const T s = T(1) / q_.next(), normal_s = T(1) / normal_q_.next();
    const T n_dot_w = normal_varying_.next() * s * normal_s;
    if constexpr (kLightVaries) result.diffuse = n_dot_w;
    if constexpr (kParts == Parts::full) {
      // R·V = 2 (N·L)(N·V) − L·V, whether L or V varies.
      const T n_dot_fixed = normal_fixed_.next() * normal_s;
      if constexpr (!kLightVaries) result.diffuse = n_dot_fixed;
      result.highlight = twice(n_dot_w * n_dot_fixed) - varying_fixed_.next() * s;
    }
    if constexpr (kSpot) result.spot = spot_.next() * s;  // eq. 37
    return result;
  }

  // Whether H·H < ¼ |N|² or ¼ |W|², or W is more than 90° from s, where the mirrored s may point
  // backwards.
  bool degenerate(double x, double y, int length) const {
    if (falls_below(square(normal_half_), x, y, length, 0.25)) return true;
    if (!kNeedsVarying) return false;
    Linear<Vector3<double>> w = half_;
    w.c -= axis_;
    const Linear<double> forwards = dot(w, axis_);
    const double last = x + length - 1;
    if (!(forwards.a * x + forwards.b * y + forwards.c > 0)) return true;
    if (!(forwards.a * last + forwards.b * y + forwards.c > 0)) return true;
    const Quadratic<double> squared = square(w);  // convex: largest at an end of the span
    const double longest = std::fmax(squared(x, y), squared(last, y));
    return falls_below(square(half_), x, y, length, 0.25 * longest);
  }

 private:
  Vector3<T> face_, fixed_, axis_;
  Linear<Vector3<T>> normal_half_, half_;
  ForwardDifferences<T, 2> normal_q_, q_, normal_fixed_, varying_fixed_, spot_;
  ForwardDifferences<T, 4> normal_varying_;
};

template <typename T, Parts kParts>
using PointReflection = ReflectedVectors<T, kParts, VaryingVector::point_light>;
template <typename T, Parts kParts>
using SpotReflection = ReflectedVectors<T, kParts, VaryingVector::spotlight>;
template <typename T, Parts kParts>
using ViewpointReflection = ReflectedVectors<T, kParts, VaryingVector::viewpoint>;

}  // namespace phongpipe
