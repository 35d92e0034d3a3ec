// Duff (1979), as Bishop & Weimer and Hast, Barrera & Bengtsson (eqs. 3–8) give it: N·L and N·N are
// polynomials along the span, p linear and q quadratic, and the cosine is p/√q. Exact Phong
// shading.
//
// E = N·N at the start of a span keeps its value here; Hast sets it to 1 (see ERRATA).
#pragma once

#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

// The polynomials that every form of Duff's method steps.
template <typename T>
class DuffSpan {
 public:
  DuffSpan() = default;
  explicit DuffSpan(const ShadingInput<T>& in) : normal(interpolated_normal(in)) {
    diffuse_ = dot(normal, in.light);
    square_ = square(normal);
  }
  void start_span(const T& x, const T& y) {
    p = start(diffuse_, x, y);
    q = start(square_, x, y);
  }
  const Quadratic<T>& squared() const { return square_; }
  const Linear<T>& diffuse() const { return diffuse_; }

  Linear<Vector3<T>> normal;
  ForwardDifferences<T, 1> p;  // N·L
  ForwardDifferences<T, 2> q;  // N·N

 private:
  Linear<T> diffuse_;
  Quadratic<T> square_;
};

// How 1/√q is computed and used.
enum class Root {
  quotients,   // p/√q: 1 division for each cosine
  reciprocal,  // s = 1/√q, p·s: Hast, section 4.2, after Blinn
  table,       // s from a table
};

// 1/√x from a table of 1,024 words, addressed by the last bit of x's exponent and the first nine of
// its fraction; halving the exponent is free. Relative error at most 4.9e-4.
double table_rsqrt(double x);
inline Recorded table_rsqrt(const Recorded& x) {
  return read_word(x);
}

template <typename T, Parts kParts, Root kRoot>
class DuffHalfway {
 public:
  explicit DuffHalfway(const ShadingInput<T>& in) : span_(in) {
    if constexpr (kParts == Parts::full) highlight_ = dot(span_.normal, in.halfway);
  }

  void start_span(const T& x, const T& y) {
    span_.start_span(x, y);
    if constexpr (kParts == Parts::full) r_ = start(highlight_, x, y);
  }

  Reflection<T> next() {
    using std::sqrt;
    const T p = span_.p.next(), q = span_.q.next();
    Reflection<T> result;
    if constexpr (kRoot == Root::quotients) {
      const T root = sqrt(q);
      result.diffuse = p / root;
      if constexpr (kParts == Parts::full) result.highlight = r_.next() / root;
    } else {
      T s;
      if constexpr (kRoot == Root::table) {
        s = table_rsqrt(q);
      } else {
        s = T(1) / sqrt(q);
      }
      result.diffuse = p * s;
      if constexpr (kParts == Parts::full) result.highlight = r_.next() * s;
    }
    return result;
  }

 private:
  DuffSpan<T> span_;
  Linear<T> highlight_;
  ForwardDifferences<T, 1> r_;
};

template <typename T, Parts kParts>
using Duff = DuffHalfway<T, kParts, Root::quotients>;
template <typename T, Parts kParts>
using DuffTable = DuffHalfway<T, kParts, Root::table>;
template <typename T, Parts kParts>
using DuffBlinn = DuffHalfway<T, kParts, Root::reciprocal>;

}  // namespace phongpipe
