// The setup engine's arithmetic: from the vertices of a triangle to the unrounded coefficients of
// every series the datapath steps. Run with double it gives values, with Recorded its dataflow.
#pragma once

#include <array>

#include "model/shading/halfway.h"
#include "model/shading/quadratics/cosine_series.h"

namespace phongpipe {

// Which series a triangle needs, and which form the halfway vector takes.
struct SeriesPlan {
  int channels = 1;
  bool local_viewer = false;
  bool gate_series = false;
  SeriesFit fit = SeriesFit::taylor;
};

template <typename T>
struct TriangleInput {
  std::array<T, 3> x, y, z;  // x and y in pixels from the expansion point
  std::array<Vector3<T>, 3> normal;
  std::array<Vector3<T>, 3> eye;  // surface → eye, of any length; read for a local viewer only
};

// What is the same for all triangles of a material.
template <typename T>
struct LightInput {
  Vector3<T> to_light;  // unit
  Vector3<T> halfway;   // unit; read for a viewer at infinity only
  std::array<T, 3> diffuse_scale;
  T specular_scale;
  T sharpness;  // shininess − 1, at least 0; read by the fits that weigh a highlight
  T gate_scale;
};

template <typename T>
struct TriangleCoefficients {
  std::array<Quadratic<T>, 3> diffuse;
  Quadratic<T> specular;
  Quadratic<T> gate;
  Linear<T> depth;
};

template <typename T>
TriangleCoefficients<T> setup_triangle(const SeriesPlan& plan, const TriangleInput<T>& triangle,
                                       const LightInput<T>& light) {
  const Interpolator<T> interpolate(triangle.x, triangle.y);
  TriangleCoefficients<T> result;
  result.depth = interpolate(triangle.z[0], triangle.z[1], triangle.z[2]);

  CosineSeries<T> series;
  if (plan.local_viewer) {
    series = fit_series(plan.fit, interpolate, triangle.normal, light.to_light,
                        halfway_at_corners(triangle.eye, light.to_light), light.sharpness);
  } else {
    series = fit_series(plan.fit, interpolate, triangle.normal, light.to_light, light.halfway,
                        light.sharpness);
  }
  for (int c = 0; c < plan.channels; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    result.diffuse[channel] = series.light.scaled(light.diffuse_scale[channel]);
  }
  if (plan.gate_series) result.gate = series.light.scaled(light.gate_scale);
  result.specular = series.highlight.scaled(light.specular_scale);
  return result;
}

}  // namespace phongpipe
