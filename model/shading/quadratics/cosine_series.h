// Quadratics in x and y for N·L and for the highlight's N·H of a triangle, by each SeriesFit.
#pragma once

#include "model/shading/quadratics/focus.h"
#include "model/shading/quadratics/nine_point_fit.h"
#include "model/shading/quadratics/series_fit.h"

namespace phongpipe {

template <typename T>
struct CosineSeries {
  Quadratic<T> light, highlight;
};

template <typename T>
using Corners = std::array<Vector3<T>, 3>;

namespace detail {

// What a weight is divided by at each kind of point, corners 1, and the power of the sensitivity
// that it is divided by. Chosen for the smallest largest errors relative to the best quadratics'.
constexpr double kMiddleSpread = 0.62, kInnerSpread = 0.45, kCentreSpread = 0.38;
constexpr double kSensitivityExponent = 1.9;

template <typename T>
Quadratic<T> expand(const NormalExpansion<T>& expansion, const Interpolator<T>&,
                    const Vector3<T>& m) {
  return expansion.infinite(m);
}
template <typename T>
Quadratic<T> expand(const NormalExpansion<T>& expansion, const Interpolator<T>& interpolate,
                    const Corners<T>& m) {
  return expansion.finite(interpolate(m[0], m[1], m[2]));
}

template <typename T>
SixValues<T> through(const Values<T, kSixPoints>& f) {
  return {{f[0], f[1], f[2]}, {f[3], f[4], f[5]}};
}

// Residuals count by the power's sensitivity to them.
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

template <typename T>
Vector3<T> at_focus(const Focus<T>&, const Vector3<T>& m) {
  return m;
}
template <typename T>
Vector3<T> at_focus(const Focus<T>& focus, const Corners<T>& m) {
  const Vector3<T> centre = focus.at_centre(m);
  return centre * rsqrt(centre.dot(centre));
}
template <typename T>
Vector3<T> around_focus(const Focus<T>&, const Vector3<T>& m) {
  return m;
}
template <typename T>
Corners<T> around_focus(const Focus<T>& focus, const Corners<T>& m) {
  return focus.corners(m, focus.at_centre(m));
}

template <typename T, typename M>
Quadratic<T> focused_series(const Interpolator<T>& interpolate, const Corners<T>& normal,
                            const NormalSamples<T, kNinePoints>& samples, const M& halfway,
                            const T& sharpness) {
  const auto cosines = samples.template cosines<kSixPoints>(halfway);
  Focus<T> focus(cosines, sharpness);
  const Vector3<T> centre = focus.at_centre(normal);
  const T cosine = centre.dot(at_focus(focus, halfway)) * rsqrt(centre.dot(centre));
  focus.shrink(cosine, cosines, sharpness);
  const NormalSamples<T, kTenPoints> near(focus.corners(normal, centre));
  const BarycentricBasis<T> basis(focus.coordinate(interpolate.coordinate_1(), 1),
                                  focus.coordinate(interpolate.coordinate_2(), 2));
  return basis(fit_sensitive(near.cosines(around_focus(focus, halfway)), sharpness));
}

}  // namespace detail

// `halfway`: one unit vector, or one at each corner. `sharpness`: how much faster than the cosine
// the highlight fades, shininess − 1.
template <typename T, typename M>
CosineSeries<T> fit_series(SeriesFit fit, const Interpolator<T>& interpolate,
                           const Corners<T>& normal, const Vector3<T>& to_light, const M& halfway,
                           const T& sharpness) {
  if (fit == SeriesFit::taylor) {
    const NormalExpansion<T> expansion(interpolate(normal[0], normal[1], normal[2]));
    return {expansion.infinite(to_light), detail::expand(expansion, interpolate, halfway)};
  }
  const BarycentricBasis<T> basis(interpolate.coordinate_1(), interpolate.coordinate_2());
  if (fit == SeriesFit::six_point) {
    const NormalSamples<T, kSixPoints> samples(normal);
    return {basis(detail::through(samples.cosines(to_light))),
            basis(detail::through(samples.cosines(halfway)))};
  }
  if (fit == SeriesFit::weighted) {
    const NormalSamples<T, kTenPoints> samples(normal);
    return {basis(fit_nine_points(samples.template cosines<kNinePoints>(to_light))),
            basis(detail::fit_sensitive(samples.cosines(halfway), sharpness))};
  }
  const NormalSamples<T, kNinePoints> samples(normal);
  return {basis(fit_nine_points(samples.cosines(to_light))),
          detail::focused_series(interpolate, normal, samples, halfway, sharpness)};
}

}  // namespace phongpipe
