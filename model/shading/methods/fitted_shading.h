// Bishop & Weimer's pixel loop with other quadratics than their Taylor series: what the setup
// engine makes of a triangle by SeriesFit. The same 2 additions a pixel for each component.
#pragma once

#include <cmath>
#include <type_traits>

#include "model/shading/halfway.h"
#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/power.h"
#include "model/shading/methods/shading_input.h"
#include "model/shading/quadratics/cosine_series.h"

namespace phongpipe {

template <typename T, Parts kParts, SeriesFit kFit, bool kLocalViewer>
class FittedSeries {
 public:
  explicit FittedSeries(const ShadingInput<T>& in) {
    const Interpolator<T> interpolate = interpolator(in);
    if constexpr (kParts == Parts::diffuse) {
      const BarycentricBasis<T> basis(interpolate.coordinate_1(), interpolate.coordinate_2());
      if constexpr (kFit == SeriesFit::six_point) {
        const NormalSamples<T, kSixPoints> samples(in.normal);
        series_.light = basis(detail::through(samples.cosines(in.light)));
      } else {
        const NormalSamples<T, kNinePoints> samples(in.normal);
        series_.light = basis(fit_nine_points(samples.cosines(in.light)));
      }
    } else {
      const T sharpness(std::max(0.0, in.power->shininess() - 1));
      if constexpr (kLocalViewer) {
        series_ = fit_series(kFit, interpolate, in.normal, in.light,
                             halfway_at_corners(in.eye, in.light), sharpness);
      } else {
        series_ = fit_series(kFit, interpolate, in.normal, in.light, in.halfway, sharpness);
      }
    }
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

  // Opposed normals leave no number behind.
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
