// Bishop & Weimer's pixel loop with the quadratics of a SeriesFit instead of their Taylor series.
// Also 2 additions a pixel for each component.
#pragma once

#include <cmath>
#include <type_traits>

#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/power.h"
#include "model/shading/methods/shading_input.h"
#include "model/shading/quadratics/reflection_series.h"

namespace phongpipe {

template <typename T, Parts kParts, SeriesFit kFit, bool kLocalViewer>
class FittedSeries {
 public:
  explicit FittedSeries(const ShadingInput<T>& in) {
    ReflectionForm form;
    form.fit = kFit;
    form.local_viewer = kLocalViewer;
    form.wanted.highlight = kParts == Parts::full;
    ReflectionTerms<T> terms;
    terms.to_light = in.light;
    terms.eye = in.viewer;
    terms.halfway = in.halfway;
    if constexpr (kParts == Parts::full) {
      terms.sharpness = T(std::max(0.0, in.power->shininess() - 1));
    }
    series_ = reflection_series(form, interpolator(in), in.normal, in.eye, in.to_light, terms);
  }

  void start_span(const T& x, const T& y) {
    light_ = start(series_.light, x, y);
    if constexpr (kParts == Parts::full) highlight_ = start(series_.highlight, x, y);
  }

  Reflection<T> next() {
    Reflection<T> result;
    result.diffuse = light_.next();
    if constexpr (kParts == Parts::full) result.highlight = highlight_.next();
    return result;
  }

  // With opposite normals, coefficients are not finite.
  bool degenerate(double x, double y, int) const {
    if constexpr (std::is_same_v<T, double>) {
      return !std::isfinite(series_.light(x, y)) ||
             (kParts == Parts::full && !std::isfinite(series_.highlight(x, y)));
    }
    return false;
  }

 private:
  CosineSeries<T> series_;
  ForwardDifferences<T, 2> light_, highlight_;
};

template <SeriesFit kFit, bool kLocalViewer>
struct Fitted {
  template <typename T, Parts kParts>
  using Series = FittedSeries<T, kParts, kFit, kLocalViewer>;
};

}  // namespace phongpipe
