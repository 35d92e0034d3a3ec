// Phong shading as Bishop & Weimer count it: the normal is stepped as a vector and normalised at
// each pixel. With a local viewer or a light at a distance their vectors are too.
#pragma once

#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

// q(x, y) along a span: 3 additions a pixel.
template <typename T>
class VectorDifferences {
 public:
  VectorDifferences() = default;
  VectorDifferences(const Linear<Vector3<T>>& q, const T& x, const T& y)
      : value_(q.a * x + q.b * y + q.c), step_(q.a) {}
  Vector3<T> next() {
    const Vector3<T> value = value_;
    value_ += step_;
    return value;
  }

 private:
  Vector3<T> value_, step_;
};

// Light and viewer at infinity.
template <typename T, Parts kParts>
class ExactPhong {
 public:
  explicit ExactPhong(const ShadingInput<T>& in)
      : light_(in.light), halfway_(in.halfway), normal_(interpolated_normal(in)) {}

  void start_span(const T& x, const T& y) { step_ = VectorDifferences<T>(normal_, x, y); }

  Reflection<T> next() {
    using std::sqrt;
    const Vector3<T> n = step_.next();
    const T length = sqrt(n.dot(n));
    Reflection<T> result;
    result.diffuse = n.dot(light_) / length;
    if constexpr (kParts == Parts::full) result.highlight = n.dot(halfway_) / length;
    return result;
  }

 private:
  Vector3<T> light_, halfway_;
  Linear<Vector3<T>> normal_;
  VectorDifferences<T> step_;
};

}  // namespace phongpipe
