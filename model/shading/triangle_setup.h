// The setup engine's arithmetic: from the vertices of a triangle to the unrounded coefficients of
// every series the datapath steps. Run with double it gives values, with Recorded its dataflow.
#pragma once

#include <array>
#include <optional>
#include <tuple>

#include "model/shading/quadratics/reflection_series.h"
#include "model/shading/quadratics/series_bound.h"

namespace phongpipe {

// All that decides what the setup engine executes for a triangle under one light.
struct SeriesPlan {
  int channels = 1;
  bool diffuse = true, specular = true;
  bool gate_series = false;
  bool depth = true, depth_cue = false;
  // Whether bounds are computed first: light that cannot reach the triangle is left out, and of a
  // highlight that cannot be seen at least the effort of its fit.
  bool bound_light = false, bound_highlight = false;
  bool dim = false;  // the highlight has been found invisible
  // The normals do not turn: under a light at infinity, and for highlights an eye there, a series
  // is its T0.
  bool flat_light = false, flat_highlight = false;
  // The fits that weigh a highlight are lost on one that cannot be seen.
  SeriesFit highlight_fit() const { return dim ? SeriesFit::six_point : form.fit; }
  ReflectionForm form;  // but for what is wanted
};

inline bool operator==(const SeriesPlan& a, const SeriesPlan& b) {
  const auto values = [](const SeriesPlan& p) {
    const ReflectionForm& f = p.form;
    return std::tie(p.channels, p.diffuse, p.specular, p.gate_series, p.depth, p.depth_cue,
                    p.bound_light, p.bound_highlight, p.dim, p.flat_light, p.flat_highlight, f.fit,
                    f.point_light, f.local_viewer, f.highlight, f.attenuated, f.spot_factor);
  };
  return values(a) == values(b);
}

template <typename T>
struct TriangleInput {
  std::array<T, 3> x, y, z;  // x and y in pixels from the expansion point
  Corners<T> normal;
  Corners<T> eye;              // surface → eye, of any length; read for a local viewer only
  Corners<T> light;            // surface → light, of true length; for point and spot lights only
  std::array<T, 3> own_share;  // of the pixel's colour under depth cueing, not clamped
};

// What is the same for all triangles of a material under one light.
template <typename T>
struct LightInput {
  ReflectionTerms<T> terms;
  std::array<T, 3> diffuse_scale;
  T specular_scale;
  T gate_scale;
};

// What the series of a triangle can reach, as cosines: of light as the weighted and focused fits
// have it, of the highlight as six_point fits it.
template <typename T>
struct TriangleBounds {
  SeriesRange<T> light, highlight;
  std::optional<QuadraticForm<T>> squared_length;  // of the normals, which setup needs again
};

template <typename T>
TriangleBounds<T> bound_triangle(const SeriesPlan& plan, const TriangleInput<T>& triangle,
                                 const LightInput<T>& light) {
  TriangleBounds<T> bounds;
  if (!plan.bound_light && !plan.bound_highlight) return bounds;
  bounds.squared_length = squared_length(triangle.normal);
  const FieldExtent<T> extent(*bounds.squared_length);
  const T remainder = taylor_remainder(extent.turn);
  if (plan.bound_light) {
    const auto range = cosine_range(triangle.normal, extent, light.terms.to_light);
    bounds.light = series_range(range, remainder, kNinePointNorm);
  }
  if (plan.bound_highlight) {
    const auto range = cosine_range(triangle.normal, extent, light.terms.halfway);
    bounds.highlight = series_range(range, remainder, kSixPointNorm);
  }
  return bounds;
}

template <typename T>
struct TriangleCoefficients {
  std::array<Quadratic<T>, 3> diffuse;
  Quadratic<T> specular;
  Quadratic<T> gate;
  Linear<T> depth;
  Linear<T> own_share;
};

// `bounds`: where they have been computed.
template <typename T>
TriangleCoefficients<T> setup_triangle(const SeriesPlan& plan, const TriangleInput<T>& triangle,
                                       const LightInput<T>& light,
                                       const TriangleBounds<T>& bounds = {}) {
  const Interpolator<T> interpolate(triangle.x, triangle.y);
  TriangleCoefficients<T> result;
  const auto interpolated = [&](const std::array<T, 3>& q) {
    return interpolate(q[0], q[1], q[2]);
  };
  if (plan.depth) result.depth = interpolated(triangle.z);
  if (plan.depth_cue) result.own_share = interpolated(triangle.own_share);

  const auto flat = [&](const Vector3<T>& m) {
    const Vector3<T>& normal = triangle.normal[0];
    return Quadratic<T>{normal.dot(m) * rsqrt(normal.dot(normal)), 0, 0, 0, 0, 0};
  };
  const auto series_of = [&](SeriesFit fit, const SeriesWanted& wanted) {
    ReflectionForm form = plan.form;
    form.fit = fit;
    form.wanted = wanted;
    return reflection_series(form, interpolate, triangle.normal, triangle.eye, triangle.light,
                             light.terms,
                             bounds.squared_length ? &*bounds.squared_length : nullptr);
  };
  const bool wants_light = plan.diffuse || plan.gate_series;
  const bool together =
      wants_light && plan.specular && !plan.flat_light && plan.highlight_fit() == plan.form.fit;
  CosineSeries<T> series;
  if (together) {
    series = series_of(plan.form.fit, {true, true});
  } else {
    if (wants_light) {
      series.light = plan.flat_light ? flat(light.terms.to_light)
                                     : series_of(plan.form.fit, {true, false}).light;
    }
    if (plan.specular) {
      series.highlight = plan.flat_highlight
                             ? flat(light.terms.halfway)
                             : series_of(plan.highlight_fit(), {false, true}).highlight;
    }
  }
  if (plan.diffuse) {
    for (int c = 0; c < plan.channels; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      result.diffuse[channel] = series.light.scaled(light.diffuse_scale[channel]);
    }
  }
  if (plan.gate_series) result.gate = series.light.scaled(light.gate_scale);
  if (plan.specular) result.specular = series.highlight.scaled(light.specular_scale);
  return result;
}

}  // namespace phongpipe
