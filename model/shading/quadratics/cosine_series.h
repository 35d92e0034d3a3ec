// Quadratics in x and y for N·L and N·H over a triangle, with L constant and H constant or linear:
// the paper's reflection.
#pragma once

#include <algorithm>
#include <type_traits>

#include "model/shading/quadratics/fitted_series.h"

namespace phongpipe {

// M, the type of the halfway vector: Vector3 if it is one unit vector everywhere, else Corners.
template <typename T, typename M>
class CosineReflection {
 public:
  // `squared_length`: |N|² over the triangle, if known already.
  CosineReflection(const Corners<T>& normal, const Vector3<T>& to_light, const M& halfway,
                   const QuadraticForm<T>* squared_length = nullptr)
      : normal_(normal), to_light_(to_light), halfway_(halfway), squared_length_(squared_length) {}

  CosineSeries<T> expanded(const Interpolator<T>& interpolate, const SeriesWanted& wanted) const {
    const NormalExpansion<T> normal(interpolate(normal_[0], normal_[1], normal_[2]));
    CosineSeries<T> result;
    if (wanted.light) result.light = normal.infinite(to_light_);
    if (wanted.highlight) {
      if constexpr (kConstant) {
        result.highlight = normal.infinite(halfway_);
      } else {
        result.highlight = normal.finite(interpolate(halfway_[0], halfway_[1], halfway_[2]));
      }
    }
    return result;
  }

  template <std::size_t lights, std::size_t highlights>
  ReflectedSamples<T, lights, highlights> sampled() const {
    using Samples = NormalSamples<T, std::max(lights, highlights)>;
    const Samples normal = squared_length_ ? Samples(normal_, *squared_length_) : Samples(normal_);
    ReflectedSamples<T, lights, highlights> result;
    if constexpr (lights > 0) result.light = normal.template cosines<lights>(to_light_);
    if constexpr (highlights > 0) result.highlight = normal.template cosines<highlights>(halfway_);
    return result;
  }

  struct Centre {
    Vector3<T> normal, halfway;
  };
  Centre at_centre(const Focus<T>& focus) const {
    return {focus.at_centre(normal_), detail::vector_at_centre(focus, halfway_)};
  }
  T highlight(const Centre& at) const {
    Vector3<T> halfway = at.halfway;
    if constexpr (!kConstant) halfway = halfway * rsqrt(halfway.dot(halfway));
    return at.normal.dot(halfway) * rsqrt(at.normal.dot(at.normal));
  }
  CosineReflection around(const Focus<T>& focus, const Centre& at) const {
    return {focus.corners(normal_, at.normal), to_light_,
            detail::vector_around(focus, halfway_, at.halfway)};
  }

 private:
  static constexpr bool kConstant = std::is_same_v<M, Vector3<T>>;

  Corners<T> normal_;
  Vector3<T> to_light_;
  M halfway_;
  const QuadraticForm<T>* squared_length_;
};

// `halfway`: one unit vector, or a vector at each corner. `sharpness`: shininess − 1.
template <typename T, typename M>
CosineSeries<T> fit_series(SeriesFit fit, const Interpolator<T>& interpolate,
                           const Corners<T>& normal, const Vector3<T>& to_light, const M& halfway,
                           const T& sharpness, const SeriesWanted& wanted = {},
                           const QuadraticForm<T>* squared_length = nullptr) {
  const CosineReflection<T, M> reflection(normal, to_light, halfway, squared_length);
  return fitted_series(fit, interpolate, reflection, sharpness, wanted);
}

}  // namespace phongpipe
