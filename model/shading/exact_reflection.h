// Phong's reflection at one pixel, as a per-pixel unit computes it: vectors are stepped along the
// row, normalised by 1/√, multiplied, and raised to the shininess. With double it computes values,
// with Recorded its operations.
#pragma once

#include "model/shading/linear.h"
#include "model/shading/quadratics/reflection_equation.h"

namespace phongpipe {

// A material under a light.
template <typename T>
struct ExactLight {
  ReflectionForm form;  // wanted.highlight: whether the material has one
  bool cone = false;    // of a spotlight: N·S is wanted even if the light does not fade towards it
  ReflectionTerms<T> terms;                // attenuation is relative to 1
  std::array<T, 3> diffuse{}, specular{};  // in output LSB
  T shininess{};
};

// Where the light falls: N·L, the base of the highlight's power, and what both are multiplied by.
template <typename T>
struct ExactPoint {
  ReflectionCosines<T> cosines;  // light_eye only where light or eye are at a finite distance
  Reflected<T> reflected;
  T attenuation{1};
};

template <typename T>
ExactPoint<T> exact_point(const ExactLight<T>& light, const PointVectors<T>& at) {
  ExactPoint<T> point;
  const ReflectionForm& form = light.form;
  if (!form.point_light && !form.local_viewer && form.highlight == Highlight::halfway) {
    const T inverse = rsqrt(at.normal.dot(at.normal));
    point.reflected.light = at.normal.dot(light.terms.to_light) * inverse;
    if (form.wanted.highlight) {
      point.reflected.highlight = at.normal.dot(light.terms.halfway) * inverse;
    }
    return point;
  }
  ReflectionForm measured = form, pure = form;
  measured.spot_factor = form.spot_factor || light.cone;
  pure.attenuated = pure.spot_factor = false;  // attenuation multiplies the sum of both terms
  point.cosines = cosines_at(measured, light.terms, at);
  point.reflected = reflected(pure, form.wanted, light.terms, point.cosines);
  if (form.attenuated) {
    const auto& [c, l, q] = light.terms.attenuation;
    point.attenuation = reciprocal((point.cosines.distance * q + l) * point.cosines.distance + c);
  }
  if (form.spot_factor) {
    const T factor = power(point.cosines.spot, light.terms.spot_exponent);
    point.attenuation = form.attenuated ? point.attenuation * factor : factor;
  }
  return point;
}

// Adds the light to a pixel's channels. Call it where N·L > 0.
template <typename T>
void add_light(const ExactLight<T>& light, const ExactPoint<T>& point, int channels,
               std::array<T, 3>& sum) {
  const bool fades = light.form.attenuated || light.form.spot_factor;
  const auto faded = [&](const T& x) { return fades ? x * point.attenuation : x; };
  const T diffuse = faded(point.reflected.light);
  T highlight{};
  if (light.form.wanted.highlight) {
    highlight = faded(power(point.reflected.highlight, light.shininess));
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
    sum[c] += light.diffuse[c] * diffuse;
    if (light.form.wanted.highlight) sum[c] += light.specular[c] * highlight;
  }
}

// Moves a colour towards that of the depth cue by the share of its own.
template <typename T>
void fade_to_cue(const std::array<T, 3>& cue, const T& own, int channels, std::array<T, 3>& color) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
    color[c] = cue[c] + (color[c] - cue[c]) * own;
  }
}

}  // namespace phongpipe
