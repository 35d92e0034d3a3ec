// Quadratics in x and y for one light over a triangle, for every reflection equation: light
// approximates A N·L, and highlight A^fold N·H or A^fold R·V, according to ReflectionForm.
#pragma once

#include <algorithm>
#include <type_traits>

#include "model/shading/halfway.h"
#include "model/shading/quadratics/cosine_series.h"
#include "model/shading/quadratics/reflection_equation.h"

namespace phongpipe {

namespace detail {

template <typename T>
const Vector3<T>& scaled_vector(const Interpolator<T>&, const Vector3<T>& v) {
  return v;
}
template <typename T>
ScaledVector<T> scaled_vector(const Interpolator<T>& interpolate, const Corners<T>& v) {
  const Linear<Vector3<T>> linear = interpolate(v[0], v[1], v[2]);
  return {linear, maximum(T(kLeastSquaredLength), linear.c.dot(linear.c))};
}
template <std::size_t points, typename T>
const Vector3<T>& vector_samples(const Vector3<T>& v) {
  return v;
}
template <std::size_t points, typename T>
NormalSamples<T, points> vector_samples(const Corners<T>& v) {
  // Forms have rounding errors of about 1e-16: even a cosine between two vanishing vectors stays
  // below 1.
  constexpr double kLeast = 1e-14;
  return {v, kLeast};
}

template <typename T>
Quadratic<T> series_of_cosine(const NormalExpansion<T>& n, const Vector3<T>& m) {
  return n.infinite(m);
}
template <typename T>
Quadratic<T> series_of_cosine(const NormalExpansion<T>& n, const ScaledVector<T>& m) {
  return n.finite(m);
}

// A single number for all points if both vectors are constant.
template <std::size_t points, typename T>
T cosines_between(const Vector3<T>& l, const Vector3<T>& e) {
  return l.dot(e);
}
template <std::size_t points, typename T>
Values<T, points> cosines_between(const Vector3<T>& l, const NormalSamples<T, points>& e) {
  return e.cosines(l);
}
template <std::size_t points, typename T, std::size_t more, typename E>
Values<T, points> cosines_between(const NormalSamples<T, more>& l, const E& e) {
  return l.template cosines<points>(e);
}
template <typename T>
const T& at_point(const T& everywhere, std::size_t) {
  return everywhere;
}
template <typename T, std::size_t points>
const T& at_point(const Values<T, points>& values, std::size_t i) {
  return values[i];
}

}  // namespace detail

// L, E, the types of the light and eye vectors: Vector3 for one unit vector everywhere, or Corners
// for vectors of true length, linear between the corners and normalised at each point.
template <typename T, typename L, typename E>
class GeneralReflection {
 public:
  GeneralReflection(const ReflectionForm& form, const ReflectionTerms<T>& terms,
                    const Corners<T>& normal, const L& light, const E& eye)
      : form_(form), terms_(terms), normal_(normal), light_(light), eye_(eye) {}

  CosineSeries<T> expanded(const Interpolator<T>& interpolate, const SeriesWanted& wanted) const {
    const NormalExpansion<T> normal(interpolate(normal_[0], normal_[1], normal_[2]));
    const auto light = detail::scaled_vector(interpolate, light_);
    ReflectionCosines<Quadratic<T>, Shared<Quadratic<T>>> at;
    at.light = detail::series_of_cosine(normal, light);
    if constexpr (kConstantLight) {
      if (wanted.highlight) {
        const auto eye = detail::scaled_vector(interpolate, eye_);
        at.eye = detail::series_of_cosine(normal, eye);
        if constexpr (kConstantEye) {
          at.light_eye = light.dot(eye);
        } else {
          at.light_eye = NormalExpansion<T>(eye).infinite(light);
        }
      }
    } else if (wanted.highlight || form_.attenuated || form_.spot_factor) {
      const NormalExpansion<T> direction(light);
      if (wanted.highlight) {
        const auto eye = detail::scaled_vector(interpolate, eye_);
        at.eye = detail::series_of_cosine(normal, eye);
        at.light_eye = detail::series_of_cosine(direction, eye);
      }
      if (form_.spot_factor) at.spot = direction.infinite(terms_.spot_axis);
      if (form_.attenuated) at.distance = direction.length();
    }
    return reflected(form_, wanted, terms_, at);
  }

  template <std::size_t lights, std::size_t highlights>
  ReflectedSamples<T, lights, highlights> sampled() const {
    constexpr std::size_t kPoints = std::max(lights, highlights);
    using All = Values<T, kPoints>;
    const NormalSamples<T, kPoints> normal(normal_);
    const auto light = detail::vector_samples<kPoints>(light_);
    const All n_l = normal.cosines(light);
    Values<T, highlights> n_e{};
    Shared<Values<T, highlights>> l_e{};
    if constexpr (highlights > 0) {
      const auto eye = detail::vector_samples<highlights>(eye_);
      n_e = normal.template cosines<highlights>(eye);
      l_e = detail::cosines_between<highlights>(light, eye);
    }
    All spot{}, distance{};
    if constexpr (!kConstantLight) {
      if (form_.spot_factor) spot = light.cosines(terms_.spot_axis);
      if (form_.attenuated) distance = light.lengths();
    }

    ReflectedSamples<T, lights, highlights> result;
    for (std::size_t i = 0; i < kPoints; ++i) {
      ReflectionCosines<T> at = {n_l[i], {}, {}, spot[i], distance[i]};
      const SeriesWanted wanted = {i < lights, i < highlights};
      if (wanted.highlight) {
        at.eye = n_e[i];
        at.light_eye = detail::at_point(l_e, i);
      }
      const Reflected<T> here = reflected(form_, wanted, terms_, at);
      if (wanted.light) result.light[i] = here.light;
      if (wanted.highlight) result.highlight[i] = here.highlight;
    }
    return result;
  }

  using Centre = PointVectors<T>;
  Centre at_centre(const Focus<T>& focus) const {
    return {focus.at_centre(normal_), detail::vector_at_centre(focus, light_),
            detail::vector_at_centre(focus, eye_)};
  }
  T highlight(const Centre& at) const {
    return reflected(form_, {false, true}, terms_, cosines_at(form_, terms_, at)).highlight;
  }
  GeneralReflection around(const Focus<T>& focus, const Centre& at) const {
    return {form_, terms_, focus.corners(normal_, at.normal),
            detail::vector_around(focus, light_, at.light),
            detail::vector_around(focus, eye_, at.eye)};
  }

 private:
  static constexpr bool kConstantLight = std::is_same_v<L, Vector3<T>>;
  static constexpr bool kConstantEye = std::is_same_v<E, Vector3<T>>;
  // A single number if light and eye are constant, else F.
  template <typename F>
  using Shared = std::conditional_t<kConstantLight && kConstantEye, T, F>;

  ReflectionForm form_;
  const ReflectionTerms<T>& terms_;
  Corners<T> normal_;
  L light_;
  E eye_;
};

// `eye` and `light`: from the surface, of true length; `eye` is read for a local viewer only,
// `light` for a light at a finite distance only. `squared_length`: |N|² over the triangle, if known
// already.
template <typename T>
CosineSeries<T> reflection_series(const ReflectionForm& form, const Interpolator<T>& interpolate,
                                  const Corners<T>& normal, const Corners<T>& eye,
                                  const Corners<T>& light, const ReflectionTerms<T>& terms,
                                  const QuadraticForm<T>* squared_length = nullptr) {
  const auto cosines = [&](const auto& halfway) {
    return fit_series(form.fit, interpolate, normal, terms.to_light, halfway, terms.sharpness,
                      form.wanted, squared_length);
  };
  const auto general = [&](const auto& l, const auto& e) {
    using L = std::decay_t<decltype(l)>;
    using E = std::decay_t<decltype(e)>;
    const GeneralReflection<T, L, E> reflection(form, terms, normal, l, e);
    return fitted_series(form.fit, interpolate, reflection, terms.sharpness, form.wanted);
  };
  if (!form.point_light && (form.highlight == Highlight::halfway || !form.wanted.highlight)) {
    if (!form.local_viewer || !form.wanted.highlight) return cosines(terms.halfway);
    // The paper's series has H linear between the corners; the fits use the exact H.
    if (form.fit == SeriesFit::taylor) return cosines(halfway_at_corners(eye, terms.to_light));
  }
  if (form.point_light) {
    return form.local_viewer ? general(light, eye) : general(light, terms.eye);
  }
  return form.local_viewer ? general(terms.to_light, eye) : general(terms.to_light, terms.eye);
}

}  // namespace phongpipe
