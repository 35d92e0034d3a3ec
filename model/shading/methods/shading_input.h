// Input and result of a shading method, templates over the scalar: double computes values, Recorded
// records the operations executed.
//
// Not counted, as in the sources: comparisons and clamps, conversions between formats, changes of
// sign and of exponent, and values that are constant over a frame (unit light, eye and halfway
// vectors).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <type_traits>

#include "model/shading/dataflow.h"
#include "model/shading/linear.h"

namespace phongpipe {

class Power;

template <typename T>
struct ShadingInput {
  std::array<T, 3> x, y;               // corners, in pixels from the origin, a pixel centre
  std::array<Vector3<T>, 3> normal;    // unit, or shorter if clipping made the corner
  std::array<Vector3<T>, 3> eye;       // surface → eye, at its true length
  std::array<Vector3<T>, 3> to_light;  // surface → light; true length unless the light is infinite
  Vector3<T> face;                     // the polygon's own normal: unit, on the side of the normals
  // The same for the whole frame, unit:
  Vector3<T> light;    // surface → a directional light
  Vector3<T> viewer;   // surface → the eye at infinity; the axis of the view for a local viewer
  Vector3<T> halfway;  // of light and viewer
  T light_dot_viewer = 0;
  Vector3<T> axis;               // surface → light along a spotlight's axis
  const Power* power = nullptr;  // of the material
};

// A method's result for the first light at a pixel.
template <typename T>
struct Reflection {
  T diffuse = 0;    // N·L, or the whole intensity from a method that shades by intensities
  T highlight = 0;  // N·H or R·V, before the power
  T spot = 1;       // the cosine off a spotlight's axis
};

// Whether a method computes both components or N·L alone.
enum class Parts { diffuse, full };

template <typename T>
Interpolator<T> interpolator(const ShadingInput<T>& in) {
  return Interpolator<T>(in.x, in.y);
}

template <typename T>
Linear<Vector3<T>> interpolated_normal(const ShadingInput<T>& in) {
  return interpolator(in)(in.normal[0], in.normal[1], in.normal[2]);
}

// A clamp is a choice of a comparator or of wiring: free, and not recorded.
inline double not_negative(double x) {
  return x > 0 ? x : 0;
}
inline Recorded not_negative(const Recorded& x) {
  return x;
}

}  // namespace phongpipe
