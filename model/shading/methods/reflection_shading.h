// Reflection shading (Hast, Barrera & Bengtsson 2001, section 4): the polygon's unit normal n is
// mirrored about H = n + N. The result always has unit length, and the direction of the
// interpolated N approximately, or exactly if N has unit length too:
//     N' = 2 (H·n)/(H·H) H − n                                                   (27)
//     N'·v = (2 (H·n)(H·v) − (n·v)(H·H)) / (H·H)                              (30–32)
// No root; numerator and denominator are quadratic along the span.
#pragma once

#include "model/shading/methods/mirror_highlights.h"

namespace phongpipe {

// Whether q falls below `floor` at one of `length` pixels from (x, y) rightwards.
inline bool falls_below(const Quadratic<double>& q, double x, double y, int length, double floor) {
  const double last = x + length - 1;
  double least = std::fmin(q(x, y), q(last, y));
  if (q.t5 > 0) {
    const double lowest = -(q.t4 * y + q.t2) / (2 * q.t5);
    if (lowest > x && lowest < last) least = std::fmin(least, q(lowest, y));
  }
  return !(least >= floor);
}

template <typename T>
class ReflectedNormal {
 public:
  explicit ReflectedNormal(const ShadingInput<T>& in)
      : normal(interpolated_normal(in)), face_(in.face), half_(normal) {
    half_.c += face_;
    face_twice_ = doubled(dot(half_, face_));
    square_ = square(half_);
  }

  // The numerator of N'·v.
  Quadratic<T> along(const Vector3<T>& v) const {
    return face_twice_ * dot(half_, v) - square_.scaled(face_.dot(v));
  }
  const Quadratic<T>& squared() const { return square_; }

  // Where N is opposite to n, H vanishes and N' is undefined. Tested as H·H < ¼ |N|², with |N| at
  // most 1.
  bool degenerate(double x, double y, int length) const {
    return falls_below(square_, x, y, length, 0.25);
  }

  Linear<Vector3<T>> normal;

 private:
  Vector3<T> face_;
  Linear<Vector3<T>> half_;
  Linear<T> face_twice_;
  Quadratic<T> square_;
};

// How the highlight is computed.
enum class ReflectionHighlight {
  quotient,  // N'·H, a quotient like N'·L
  blinn,     // both numerators times 1/(H·H)
  hybrid,    // R·V by eq. 17 from the interpolated normal itself
  eq34,      // R·V by eq. 34 from N'
};

template <typename T, Parts kParts, ReflectionHighlight kHighlight>
class ReflectionShading {
 public:
  explicit ReflectionShading(const ShadingInput<T>& in)
      : light_dot_viewer_(in.light_dot_viewer), reflected_(in) {
    diffuse_ = reflected_.along(in.light);
    if constexpr (kParts == Parts::diffuse) return;
    if constexpr (kHighlight == ReflectionHighlight::hybrid) {
      square_ = square(reflected_.normal);
      highlight_ =
          mirror_numerator(in, reflected_.normal, dot(reflected_.normal, in.light), square_);
    } else if constexpr (kHighlight == ReflectionHighlight::eq34) {
      highlight_ = doubled(reflected_.along(in.viewer));
    } else {
      highlight_ = reflected_.along(in.halfway);
    }
  }

  void start_span(const T& x, const T& y) {
    p_ = start(diffuse_, x, y);
    q_ = start(reflected_.squared(), x, y);
    if constexpr (kParts == Parts::diffuse) return;
    r_ = start(highlight_, x, y);
    if constexpr (kHighlight == ReflectionHighlight::hybrid) normal_q_ = start(square_, x, y);
  }

  Reflection<T> next() {
    const T p = p_.next(), q = q_.next();
    Reflection<T> result;
    if constexpr (kParts == Parts::diffuse) {
      result.diffuse = p / q;
    } else if constexpr (kHighlight == ReflectionHighlight::quotient) {
      result.diffuse = p / q;
      result.highlight = r_.next() / q;
    } else if constexpr (kHighlight == ReflectionHighlight::hybrid) {
      result.diffuse = p / q;
      result.highlight = r_.next() / normal_q_.next();
    } else {
      const T s = T(1) / q;
      result.diffuse = p * s;
      result.highlight = r_.next() * s;
      if constexpr (kHighlight == ReflectionHighlight::eq34) {
        result.highlight = result.highlight * result.diffuse - light_dot_viewer_;
      }
    }
    return result;
  }

  bool degenerate(double x, double y, int length) const {
    return reflected_.degenerate(x, y, length);
  }

 private:
  T light_dot_viewer_;
  ReflectedNormal<T> reflected_;
  Quadratic<T> diffuse_, highlight_, square_;
  ForwardDifferences<T, 2> p_, q_, r_, normal_q_;
};

template <typename T, Parts kParts>
using ReflectionQuotient = ReflectionShading<T, kParts, ReflectionHighlight::quotient>;
template <typename T, Parts kParts>
using ReflectionBlinn = ReflectionShading<T, kParts, ReflectionHighlight::blinn>;
template <typename T, Parts kParts>
using ReflectionHybrid = ReflectionShading<T, kParts, ReflectionHighlight::hybrid>;
template <typename T, Parts kParts>
using ReflectionEq34 = ReflectionShading<T, kParts, ReflectionHighlight::eq34>;

}  // namespace phongpipe
