// Bishop & Weimer's method: the reflection equation's second-degree series, 2 additions a pixel for
// each component. The coefficients are those of model/shading/taylor.h.
#pragma once

#include "model/shading/halfway.h"
#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

template <typename T, Parts kParts, bool kLocalViewer>
class TaylorSeries {
 public:
  explicit TaylorSeries(const ShadingInput<T>& in) {
    const Interpolator<T> interpolate = interpolator(in);
    const Linear<Vector3<T>> n = interpolate(in.normal[0], in.normal[1], in.normal[2]);
    const NormalExpansion<T> normal(n);
    normal_ = n.c;
    diffuse_ = normal.infinite(in.light);
    if constexpr (kParts == Parts::full) {
      if constexpr (kLocalViewer) {
        const auto halfway = halfway_at_corners(in.eye, in.light);
        const Linear<Vector3<T>> h = interpolate(halfway[0], halfway[1], halfway[2]);
        halfway_ = h.c;
        highlight_ = normal.finite(h);
      } else {
        highlight_ = normal.infinite(in.halfway);
      }
    }
  }

  void start_span(const T& x, const T& y) {
    p_ = start(diffuse_, x, y);
    if constexpr (kParts == Parts::full) r_ = start(highlight_, x, y);
  }

  Reflection<T> next() {
    Reflection<T> result;
    result.diffuse = p_.next();
    if constexpr (kParts == Parts::full) result.highlight = r_.next();
    return result;
  }

  // Opposite normals, or an eye opposite to the light: the vector at the origin nearly vanishes,
  // and the series divides by its length.
  bool degenerate(double, double, int) const {
    constexpr double kLeastNormal = 0.1, kLeastHalfway = 0.01;
    if (!(normal_.norm() > kLeastNormal)) return true;
    return kLocalViewer && kParts == Parts::full && !(halfway_.norm() > kLeastHalfway);
  }

 private:
  Vector3<T> normal_, halfway_;  // at the origin
  Quadratic<T> diffuse_, highlight_;
  ForwardDifferences<T, 2> p_, r_;
};

template <typename T, Parts kParts>
using Taylor = TaylorSeries<T, kParts, false>;
template <typename T, Parts kParts>
using TaylorLocal = TaylorSeries<T, kParts, true>;

}  // namespace phongpipe
