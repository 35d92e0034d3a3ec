// Fits the two series of a light's reflection over a triangle by any SeriesFit. A Reflection has
//   expanded(interpolate, wanted)     the Taylor series of light and highlight,
//   sampled<lights, highlights>()     light and highlight at that many first sample points
//                                     (cosine_samples.h), 0 for none,
//   at_centre(focus), highlight(…)    its vectors, and its highlight, at the centre of a focus,
//   around(focus, …)                  the same reflection over the smaller triangle of a focus.
#pragma once

#include "model/shading/quadratics/focus.h"
#include "model/shading/quadratics/nine_point_fit.h"
#include "model/shading/quadratics/series_fit.h"

namespace phongpipe {

template <typename T>
using CosineSeries = Reflected<Quadratic<T>>;

template <typename T>
using Corners = std::array<Vector3<T>, 3>;

template <typename T, std::size_t lights, std::size_t highlights>
struct ReflectedSamples {
  Values<T, lights> light{};
  Values<T, highlights> highlight{};
};

namespace detail {

// The weight of a squared residual is sensitivity^kSensitivityExponent, divided by the spread of
// its kind of point: 1 at corners, else these. Chosen for the smallest largest error relative to
// that of the best quadratics.
constexpr double kMiddleSpread = 0.62, kInnerSpread = 0.45, kCentreSpread = 0.38;
constexpr double kSensitivityExponent = 1.9;

template <typename T>
SixValues<T> through(const Values<T, kSixPoints>& f) {
  return {{f[0], f[1], f[2]}, {f[3], f[4], f[5]}};
}

// Fits ten points with residuals weighted by the sensitivity of the power.
template <typename T>
SixValues<T> fit_sensitive(const Values<T, kTenPoints>& f, const T& sharpness) {
  const Fading<T> fading(sharpness * T(kSensitivityExponent / 8));
  Values<T, kTenPoints> spread;
  for (std::size_t i = 0; i < kTenPoints; ++i) {
    spread[i] = eighth_power(fading(f[i]));
    const double kind = i < 6 ? kMiddleSpread : i < 9 ? kInnerSpread : kCentreSpread;
    if (i >= 3) spread[i] = spread[i] * T(kind);
  }
  return fit_ten_points(f, spread);
}

// For a vector that is one unit vector everywhere, and for one that is linear between the corners.
template <typename T>
Vector3<T> vector_at_centre(const Focus<T>&, const Vector3<T>& v) {
  return v;
}
template <typename T>
Vector3<T> vector_at_centre(const Focus<T>& focus, const Corners<T>& v) {
  return focus.at_centre(v);
}
template <typename T>
Vector3<T> vector_around(const Focus<T>&, const Vector3<T>& v, const Vector3<T>&) {
  return v;
}
template <typename T>
Corners<T> vector_around(const Focus<T>& focus, const Corners<T>& v, const Vector3<T>& at_centre) {
  return focus.corners(v, at_centre);
}

template <std::size_t lights, std::size_t highlights, typename T, typename Reflection>
ReflectedSamples<T, lights, highlights> wanted_samples(const Reflection& reflection,
                                                       const SeriesWanted& wanted) {
  if (wanted.light && wanted.highlight) return reflection.template sampled<lights, highlights>();
  ReflectedSamples<T, lights, highlights> result;
  if (wanted.light) result.light = reflection.template sampled<lights, 0>().light;
  if (wanted.highlight) result.highlight = reflection.template sampled<0, highlights>().highlight;
  return result;
}

// `highlights`: samples over the whole triangle.
template <typename T, typename Reflection>
Quadratic<T> focused_highlight(const Interpolator<T>& interpolate, const Reflection& reflection,
                               const Values<T, kSixPoints>& highlights, const T& sharpness) {
  Focus<T> focus(highlights, sharpness);
  const auto centre = reflection.at_centre(focus);
  focus.shrink(reflection.highlight(centre), highlights, sharpness);
  const Reflection near = reflection.around(focus, centre);
  const BarycentricBasis<T> basis(focus.coordinate(interpolate.coordinate_1(), 1),
                                  focus.coordinate(interpolate.coordinate_2(), 2));
  return basis(fit_sensitive(near.template sampled<0, kTenPoints>().highlight, sharpness));
}

}  // namespace detail

// `sharpness`: shininess − 1.
template <typename T, typename Reflection>
CosineSeries<T> fitted_series(SeriesFit fit, const Interpolator<T>& interpolate,
                              const Reflection& reflection, const T& sharpness,
                              const SeriesWanted& wanted) {
  if (fit == SeriesFit::taylor) return reflection.expanded(interpolate, wanted);
  CosineSeries<T> result;
  const auto basis = [&interpolate] {
    return BarycentricBasis<T>(interpolate.coordinate_1(), interpolate.coordinate_2());
  };
  if (fit == SeriesFit::focused) {
    const auto samples = detail::wanted_samples<kNinePoints, kSixPoints, T>(reflection, wanted);
    if (wanted.light) result.light = basis()(fit_nine_points(samples.light));
    if (wanted.highlight) {
      result.highlight =
          detail::focused_highlight(interpolate, reflection, samples.highlight, sharpness);
    }
    return result;
  }
  const BarycentricBasis<T> whole = basis();
  if (fit == SeriesFit::six_point) {
    const auto samples = detail::wanted_samples<kSixPoints, kSixPoints, T>(reflection, wanted);
    if (wanted.light) result.light = whole(detail::through(samples.light));
    if (wanted.highlight) result.highlight = whole(detail::through(samples.highlight));
    return result;
  }
  const auto samples = detail::wanted_samples<kNinePoints, kTenPoints, T>(reflection, wanted);
  if (wanted.light) result.light = whole(fit_nine_points(samples.light));
  if (wanted.highlight) {
    result.highlight = whole(detail::fit_sensitive(samples.highlight, sharpness));
  }
  return result;
}

}  // namespace phongpipe
