// Phong shading as Bishop & Weimer count it: the normal is stepped as a vector and normalised at
// each pixel. So are the eye vector of a local viewer and the vector to a light at a finite
// distance.
#pragma once

#include "model/shading/methods/forward_differences.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

// Steps a vector q(x, y) along a span: 3 additions a pixel.
template <typename T>
class VectorDifferences {
 public:
  VectorDifferences() = default;
  VectorDifferences(const Linear<Vector3<T>>& q, const T& x, const T& y)
      : value_(q.a * x + q.b * y + q.c), step_(q.a) {}
  Vector3<T> next() {
    Vector3<T> value = value_;
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

// Which vectors vary over the triangle, and how the highlight is defined.
struct PhongForm {
  bool local_viewer = false;
  bool light_at_distance = false;
  bool mirror = false;  // R·V in place of N·H
};

template <typename T>
Vector3<T> unit(const Vector3<T>& v) {
  using std::sqrt;
  return v * (T(1) / sqrt(v.dot(v)));
}

// The general case: vectors that vary are interpolated, and normalised at each pixel like the
// normal.
template <typename T, Parts kParts>
class VaryingPhong {
 public:
  VaryingPhong(const ShadingInput<T>& in, const PhongForm& form)
      : form_(form), light_(in.light), viewer_(in.viewer), light_dot_viewer_(in.light_dot_viewer) {
    const Interpolator<T> interpolate = interpolator(in);
    const auto vector = [&](const auto& v) { return interpolate(v[0], v[1], v[2]); };
    normal_ = vector(in.normal);
    if (form.light_at_distance) to_light_ = vector(in.to_light);
    if (form.local_viewer && kParts == Parts::full) eye_ = vector(in.eye);
  }

  void start_span(const T& x, const T& y) {
    normal_step_ = VectorDifferences<T>(normal_, x, y);
    if (form_.light_at_distance) light_step_ = VectorDifferences<T>(to_light_, x, y);
    if (form_.local_viewer && kParts == Parts::full) eye_step_ = VectorDifferences<T>(eye_, x, y);
  }

  Reflection<T> next() {
    using std::sqrt;
    const Vector3<T> n = unit(normal_step_.next());
    const Vector3<T> l = form_.light_at_distance ? unit(light_step_.next()) : light_;
    Reflection<T> result;
    result.diffuse = n.dot(l);
    if constexpr (kParts == Parts::full) {
      const Vector3<T> v = form_.local_viewer ? unit(eye_step_.next()) : viewer_;
      if (form_.mirror) {
        const bool constant = !form_.light_at_distance && !form_.local_viewer;
        const T l_dot_v = constant ? light_dot_viewer_ : l.dot(v);
        result.highlight = twice(result.diffuse * n.dot(v)) - l_dot_v;
      } else {
        const Vector3<T> h = l + v;
        result.highlight = n.dot(h) / sqrt(h.dot(h));
      }
    }
    return result;
  }

 private:
  PhongForm form_;
  Vector3<T> light_, viewer_;
  T light_dot_viewer_;
  Linear<Vector3<T>> normal_, to_light_, eye_;
  VectorDifferences<T> normal_step_, light_step_, eye_step_;
};

}  // namespace phongpipe
