// Hast, Barrera & Bengtsson (2001), sections 3 and 4.2: R·V needs no unit normal,
//     R·V = 2 (N·V)(N·L) / (N·N) − L·V                                          (17)
// The source has V = (0, 0, −1); V is any unit vector here.
#pragma once

#include "model/shading/methods/duff.h"
#include "model/shading/methods/intensity_shading.h"

namespace phongpipe {

// Eq. 17 over the common denominator (eqs. 20–22): (2 (N·V)(N·L) − (L·V)(N·N)) / (N·N).
template <typename T>
Quadratic<T> mirror_numerator(const ShadingInput<T>& in, const Linear<Vector3<T>>& normal,
                              const Linear<T>& n_dot_l, const Quadratic<T>& squared) {
  return doubled(dot(normal, in.viewer)) * n_dot_l - squared.scaled(in.light_dot_viewer);
}

// Hybrid shading: Gouraud's diffuse component, eq. 17's highlight.
template <typename T, Parts kParts>
class Hybrid {
 public:
  explicit Hybrid(const ShadingInput<T>& in) : diffuse_(in) {
    if constexpr (kParts == Parts::full) {
      const Linear<Vector3<T>> normal = interpolated_normal(in);
      square_ = square(normal);
      numerator_ = mirror_numerator(in, normal, dot(normal, in.light), square_);
    }
  }

  void start_span(const T& x, const T& y) {
    diffuse_.start_span(x, y);
    if constexpr (kParts == Parts::full) {
      r_ = start(numerator_, x, y);
      q_ = start(square_, x, y);
    }
  }

  Reflection<T> next() {
    Reflection<T> result = diffuse_.next();
    if constexpr (kParts == Parts::full) result.highlight = r_.next() / q_.next();
    return result;
  }

 private:
  Gouraud<T, Parts::diffuse> diffuse_;
  Quadratic<T> numerator_, square_;
  ForwardDifferences<T, 2> r_, q_;
};

// Duff's diffuse component p/√q, and eq. 17 as a separate quotient.
template <typename T, Parts kParts>
class DuffEq17 {
 public:
  explicit DuffEq17(const ShadingInput<T>& in) : span_(in) {
    if constexpr (kParts == Parts::full) {
      numerator_ = mirror_numerator(in, span_.normal, span_.diffuse(), span_.squared());
    }
  }

  void start_span(const T& x, const T& y) {
    span_.start_span(x, y);
    if constexpr (kParts == Parts::full) r_ = start(numerator_, x, y);
  }

  Reflection<T> next() {
    using std::sqrt;
    const T p = span_.p.next(), q = span_.q.next();
    Reflection<T> result;
    result.diffuse = p / sqrt(q);
    if constexpr (kParts == Parts::full) result.highlight = r_.next() / q;
    return result;
  }

 private:
  DuffSpan<T> span_;
  Quadratic<T> numerator_;
  ForwardDifferences<T, 2> r_;
};

// Duff with r = 2 N·V stepped beside p and q: eq. 33, R·V = r (p/q) − L·V, or with s = 1/√q
// eq. 34, R·V = r s p s − L·V.
template <typename T, Parts kParts, bool kReciprocal>
class DuffMirror {
 public:
  explicit DuffMirror(const ShadingInput<T>& in)
      : light_dot_viewer_(in.light_dot_viewer), span_(in) {
    if constexpr (kParts == Parts::full) viewer_ = doubled(dot(span_.normal, in.viewer));
  }

  void start_span(const T& x, const T& y) {
    span_.start_span(x, y);
    if constexpr (kParts == Parts::full) r_ = start(viewer_, x, y);
  }

  Reflection<T> next() {
    using std::sqrt;
    const T p = span_.p.next(), q = span_.q.next();
    Reflection<T> result;
    if constexpr (kReciprocal) {
      const T s = T(1) / sqrt(q);
      result.diffuse = p * s;
      if constexpr (kParts == Parts::full) {
        result.highlight = r_.next() * s * result.diffuse - light_dot_viewer_;
      }
    } else {
      result.diffuse = p / sqrt(q);
      if constexpr (kParts == Parts::full) {
        result.highlight = r_.next() * (p / q) - light_dot_viewer_;
      }
    }
    return result;
  }

 private:
  T light_dot_viewer_;
  DuffSpan<T> span_;
  Linear<T> viewer_;
  ForwardDifferences<T, 1> r_;
};

template <typename T, Parts kParts>
using DuffEq33 = DuffMirror<T, kParts, false>;
template <typename T, Parts kParts>
using DuffEq34 = DuffMirror<T, kParts, true>;

}  // namespace phongpipe
