// The setup engine's arithmetic: from the vertices of a triangle to the unrounded coefficients of
// every series the datapath steps. With double it computes values, with Recorded its dataflow.
#pragma once

#include <array>
#include <optional>

#include "model/shading/fields.h"
#include "model/shading/quadratics/reflection_bound.h"
#include "model/shading/quadratics/reflection_series.h"
#include "model/shading/quadratics/series_bound.h"

namespace phongpipe {

// Which coefficients of a series are set up: none; T0 alone, if all normals are equal and the light
// (for highlights also the eye) is at infinity; or all six.
enum class SeriesForm { absent, constant, fitted };
inline bool is_present(SeriesForm form) {
  return form != SeriesForm::absent;
}

// Determines the operations that the setup engine executes for a triangle under one light.
struct SeriesPlan {
  int channels = 1;
  SeriesForm diffuse = SeriesForm::fitted;  // one series per channel, a multiple of N·L
  SeriesForm gate = SeriesForm::absent;     // a separate series of N·L
  SeriesForm specular = SeriesForm::fitted;
  bool depth = true, depth_cue = false;  // linear series
  // Whether bounds of the series are computed first. A light that cannot reach the triangle is then
  // left out; a highlight that cannot be seen is left out, or at least fitted without weights.
  bool bound_light = false, bound_highlight = false;
  bool highlight_invisible = false;              // proved by its bound
  bool certify = false;                          // whether the error of the series is bounded, too
  bool exact_path = false;                       // the series are absent, and exact_path is set up
  std::optional<SeriesFit> certified_highlight;  // fit of the highlight, if it has its own
  ReflectionForm form;                           // except form.wanted, which setup_triangle() sets

  static constexpr auto fields() {
    using P = SeriesPlan;
    return std::make_tuple(
        field("channels", &P::channels), field("diffuse", &P::diffuse), field("gate", &P::gate),
        field("specular", &P::specular), field("depth", &P::depth),
        field("depth_cue", &P::depth_cue), field("bound_light", &P::bound_light),
        field("bound_highlight", &P::bound_highlight),
        field("highlight_invisible", &P::highlight_invisible), field("certify", &P::certify),
        field("exact_path", &P::exact_path), field("certified_highlight", &P::certified_highlight),
        field("form", &P::form));
  }

  // The form of the N·L series that diffuse and gate are multiples of.
  SeriesForm light() const { return is_present(diffuse) ? diffuse : gate; }
  // The fit of the highlight: one without weights if the highlight cannot be seen.
  SeriesFit highlight_fit() const {
    return highlight_invisible ? SeriesFit::six_point : certified_highlight.value_or(form.fit);
  }
};

inline bool operator==(const SeriesPlan& a, const SeriesPlan& b) {
  return equal_fields(a, b);
}

template <typename T>
struct TriangleInput {
  std::array<T, 3> x, y, z;  // x and y in pixels from the expansion point
  Corners<T> normal;
  Corners<T> eye;               // surface → eye, of any length; read for a local viewer only
  Corners<T> light;             // surface → light, of true length; for point and spot lights only
  std::array<T, 3> cue_factor;  // share of the pixel's own colour under depth cueing, not clamped
};

// Inputs that are the same for all triangles of a material under one light.
template <typename T>
struct LightInput {
  ReflectionTerms<T> terms;
  std::array<T, 3> diffuse_scale;
  T specular_scale;
  T gate_scale;
};

// Bounds of a triangle's series, as cosines: of N·L for the weighted and focused fits, of the
// highlight for the six_point fit. If errors are certified: of both series by any fit.
template <typename T>
struct TriangleBounds {
  SeriesRange<T> light, highlight;
  std::optional<QuadraticForm<T>> squared_length;  // |N|², which setup reuses
  std::optional<Reflected<ReflectionBound<T>>> certified;
};

template <typename T>
TriangleBounds<T> bound_triangle(const SeriesPlan& plan, const TriangleInput<T>& triangle,
                                 const LightInput<T>& light) {
  TriangleBounds<T> bounds;
  if (plan.certify) {
    bounds.certified =
        bound_reflection(plan.form, light.terms, triangle.normal, triangle.eye, triangle.light);
    const auto range = [](const ReflectionBound<T>& bound) {
      const T off = bound.third * taylor_error(T(1));  // at most that far from a corner
      return SeriesRange<T>{bound.low - off, bound.high + off};
    };
    bounds.light = range(bounds.certified->light);
    bounds.highlight = range(bounds.certified->highlight);
    return bounds;
  }
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
  Linear<T> cue_factor;
};

// The linear series of the plan, all the rest being 0.
template <typename T>
TriangleCoefficients<T> linear_coefficients(const SeriesPlan& plan,
                                            const Interpolator<T>& interpolate,
                                            const TriangleInput<T>& triangle) {
  TriangleCoefficients<T> result;
  const auto interpolated = [&](const std::array<T, 3>& q) {
    return interpolate(q[0], q[1], q[2]);
  };
  if (plan.depth) result.depth = interpolated(triangle.z);
  if (plan.depth_cue) result.cue_factor = interpolated(triangle.cue_factor);
  return result;
}

// The plan's series of N·L and of the highlight, as cosines. `bounds`: from bound_triangle().
template <typename T>
CosineSeries<T> cosine_series(const SeriesPlan& plan, const Interpolator<T>& interpolate,
                              const TriangleInput<T>& triangle, const ReflectionTerms<T>& terms,
                              const TriangleBounds<T>& bounds) {
  const auto constant = [&](const Vector3<T>& m) {
    const Vector3<T>& normal = triangle.normal[0];
    return Quadratic<T>{normal.dot(m) * rsqrt(normal.dot(normal)), 0, 0, 0, 0, 0};
  };
  const auto series_of = [&](SeriesFit fit, const SeriesWanted& wanted) {
    ReflectionForm form = plan.form;
    form.fit = fit;
    form.wanted = wanted;
    return reflection_series(form, interpolate, triangle.normal, triangle.eye, triangle.light,
                             terms, bounds.squared_length ? &*bounds.squared_length : nullptr);
  };
  const bool together = plan.light() == SeriesForm::fitted && plan.specular == SeriesForm::fitted &&
                        plan.highlight_fit() == plan.form.fit;
  if (together) return series_of(plan.form.fit, {true, true});
  CosineSeries<T> series;
  if (plan.light() == SeriesForm::constant) series.light = constant(terms.to_light);
  if (plan.light() == SeriesForm::fitted) {
    series.light = series_of(plan.form.fit, {true, false}).light;
  }
  if (plan.specular == SeriesForm::constant) series.highlight = constant(terms.halfway);
  if (plan.specular == SeriesForm::fitted) {
    series.highlight = series_of(plan.highlight_fit(), {false, true}).highlight;
  }
  return series;
}

// Scales cosines to the units of the plan's series.
template <typename T>
void scale_series(const SeriesPlan& plan, const LightInput<T>& light, const CosineSeries<T>& series,
                  TriangleCoefficients<T>& result) {
  if (is_present(plan.diffuse)) {
    for (int c = 0; c < plan.channels; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      result.diffuse[channel] = series.light.scaled(light.diffuse_scale[channel]);
    }
  }
  if (is_present(plan.gate)) result.gate = series.light.scaled(light.gate_scale);
  if (is_present(plan.specular)) result.specular = series.highlight.scaled(light.specular_scale);
}

// All of it.
template <typename T>
TriangleCoefficients<T> setup_triangle(const SeriesPlan& plan, const TriangleInput<T>& triangle,
                                       const LightInput<T>& light,
                                       const TriangleBounds<T>& bounds) {
  const Interpolator<T> interpolate(triangle.x, triangle.y);
  TriangleCoefficients<T> result = linear_coefficients(plan, interpolate, triangle);
  scale_series(plan, light, cosine_series(plan, interpolate, triangle, light.terms, bounds),
               result);
  return result;
}

}  // namespace phongpipe
