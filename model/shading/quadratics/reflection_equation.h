// The reflection equation of one light in cosines between directions, for values at a point or for
// power series. The two quadratics of a light approximate its results.
#pragma once

#include <array>

#include "model/scene/scene.h"
#include "model/shading/fields.h"
#include "model/shading/quadratics/sensitivity.h"
#include "model/shading/quadratics/series_fit.h"
#include "model/shading/quadratics/truncated_series.h"

namespace phongpipe {

// Determines which operations are executed.
struct ReflectionForm {
  SeriesFit fit = SeriesFit::taylor;
  bool point_light = false;  // at a finite distance, spots included
  bool local_viewer = false;
  Highlight highlight = Highlight::halfway;
  bool attenuated = false;   // by distance; point_light only
  bool spot_factor = false;  // point_light only
  SeriesWanted wanted;

  static constexpr auto fields() {
    using F = ReflectionForm;
    return std::make_tuple(field("fit", &F::fit), field("point_light", &F::point_light),
                           field("local_viewer", &F::local_viewer),
                           field("highlight", &F::highlight), field("attenuated", &F::attenuated),
                           field("spot_factor", &F::spot_factor), field("wanted", &F::wanted));
  }
};
inline bool operator==(const ReflectionForm& a, const ReflectionForm& b) {
  return equal_fields(a, b);
}

// Values that are the same for all triangles. The attenuation is A = 1/(c + l d + q d²) · max(0,
// −L·S)^e, relative to a positive reference: the caller multiplies c, l and q by the reference
// beforehand, and light and highlights afterwards. It is 1 without attenuation by distance, else it
// should be the largest attenuation that occurs: highlights saturate above it, and A above
// kLargestAttenuation times it.
template <typename T>
struct ReflectionTerms {
  Vector3<T> to_light;           // unit; read for a directional light
  Vector3<T> eye;                // unit, surface → eye; read for a viewer at infinity
  Vector3<T> halfway;            // unit; read if to_light and eye are, for N·H
  std::array<T, 3> attenuation;  // c, l, q times the reference
  Vector3<T> spot_axis;          // unit, −S: opposite to the direction of the light
  T spot_exponent;
  T fold;       // 1/shininess, so that (A^fold · cosine)^shininess = A · cosine^shininess
  T sharpness;  // shininess − 1, at least 0; read by weighted and focused fits
};

constexpr double kLargestAttenuation = 8;

// Cosines between the unit vectors N, L, E and the spot's axis, and the light's distance. F: a
// number at a point or a Quadratic; C: the same, or a number where L and E are constant.
template <typename F, typename C = F>
struct ReflectionCosines {
  F light{}, eye{};  // N·L, N·E
  C light_eye{};     // L·E
  F spot{}, distance{};
};

// Vectors at a point, of any length: that of a light at a finite distance is its distance, and
// vectors of lights and eyes at infinity are unit.
template <typename T>
struct PointVectors {
  Vector3<T> normal, light, eye;
};

// Vectors of true length vanish if a light or the eye lies on the surface; results must stay
// finite.
constexpr double kLeastSquaredLength = 1e-30;

template <typename T>
ReflectionCosines<T> cosines_at(const ReflectionForm& form, const ReflectionTerms<T>& terms,
                                const PointVectors<T>& at) {
  const Vector3<T> normal = at.normal * rsqrt(at.normal.dot(at.normal));
  Vector3<T> light = at.light, eye = at.eye;
  ReflectionCosines<T> cosines;
  if (form.point_light) {
    const T squared = maximum(T(kLeastSquaredLength), light.dot(light));
    const T inverse = rsqrt(squared);
    light = light * inverse;
    if (form.spot_factor) cosines.spot = light.dot(terms.spot_axis);
    if (form.attenuated) cosines.distance = squared * inverse;
  }
  if (form.local_viewer) {
    eye = eye * rsqrt(maximum(T(kLeastSquaredLength), eye.dot(eye)));
  }
  cosines.light = normal.dot(light);
  cosines.eye = normal.dot(eye);
  cosines.light_eye = light.dot(eye);
  return cosines;
}

// Least |E + L|², reached if E and L are opposite. The highlight is 0 there and only has to be
// finite. Surfaces that are both lit and seen are far from it.
constexpr double kLeastHalfway = 1e-6;

// Light: A N·L, not clamped, negative where unlit. Highlight: A^fold N·H or A^fold R·V.
template <typename T, typename F, typename C>
Reflected<F> reflected(const ReflectionForm& form, const SeriesWanted& wanted,
                       const ReflectionTerms<T>& terms, const ReflectionCosines<F, C>& at) {
  Reflected<F> result;
  if (wanted.light) result.light = at.light;
  if (wanted.highlight) {
    result.highlight =
        form.highlight == Highlight::halfway
            ? (at.light + at.eye) * rsqrt(at_least(T(kLeastHalfway), twice(at.light_eye + T(1))))
            : twice(at.light * at.eye) - at.light_eye;
  }
  if (!form.attenuated && !form.spot_factor) return result;
  F attenuation{};
  if (form.attenuated) {
    const auto& [c, l, q] = terms.attenuation;
    attenuation = reciprocal((at.distance * q + l) * at.distance + c);
  }
  if (form.spot_factor) {
    const F factor = power(at.spot, terms.spot_exponent);
    attenuation = form.attenuated ? attenuation * factor : factor;
  }
  if (form.attenuated) attenuation = at_most(T(kLargestAttenuation), attenuation);
  if (wanted.light) result.light = result.light * attenuation;
  if (wanted.highlight) result.highlight = result.highlight * power(attenuation, terms.fold);
  return result;
}

}  // namespace phongpipe
