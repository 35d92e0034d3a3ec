// Flat and Gouraud shading (Gouraud 1971): intensities, computed once per triangle or at its
// corners. Here for one channel and one light, without ambient light.
#pragma once

#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/power.h"

namespace phongpipe {

// Intensity for a normal of any length; `root`: 1/|normal|. Two cosines, the power and a sum.
template <typename T, Parts kParts>
T intensity(const ShadingInput<T>& in, const Vector3<T>& normal, const T& root) {
  const T diffuse = not_negative(normal.dot(in.light) * root);
  if constexpr (kParts == Parts::full) {
    return diffuse + (*in.power)(normal.dot(in.halfway) * root);
  }
  return diffuse;
}

// One intensity per triangle, computed from the polygon's own normal.
template <typename T, Parts kParts>
class Flat {
 public:
  explicit Flat(const ShadingInput<T>& in) {
    intensity_ = not_negative(in.face.dot(in.light));
    if constexpr (kParts == Parts::full) intensity_ += (*in.power)(in.face.dot(in.halfway));
  }
  explicit Flat(const T& intensity) : intensity_(intensity) {}

  void start_span(const T&, const T&) {}
  Reflection<T> next() { return {intensity_, 0, 1}; }

 private:
  T intensity_;
};

// Intensity interpolated linearly between the corners: 1 addition a pixel.
template <typename T, Parts kParts>
class Gouraud {
 public:
  explicit Gouraud(const ShadingInput<T>& in) {
    std::array<T, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3<T>& n = in.normal[i];
      corner[i] = intensity<T, kParts>(in, n, rsqrt(n.dot(n)));
    }
    intensity_ = interpolator(in)(corner[0], corner[1], corner[2]);
  }
  explicit Gouraud(const Linear<T>& intensity) : intensity_(intensity) {}

  void start_span(const T& x, const T& y) { step_ = start(intensity_, x, y); }
  Reflection<T> next() { return {step_.next(), 0, 1}; }

 private:
  Linear<T> intensity_;
  ForwardDifferences<T, 1> step_;
};

}  // namespace phongpipe
