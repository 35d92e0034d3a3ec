// A whole frame in real arithmetic. Colours are in LSB and not rounded; the background stands where
// nothing is covered.
#pragma once

#include <vector>

#include "model/shading/methods/shading_method.h"
#include "testbench/methods/visibility.h"

namespace phongpipe {

// Exact Phong shading of everything the scene format describes.
std::vector<Color> render_phong(const Scene& scene, const Geometry& geometry,
                                const Visibility& visibility);

// The limit for six numbers a triangle: the best quadratics in place of each light's cosines, with
// exact powers; the fading of lights and their cones are exact.
std::vector<Color> render_best(const Scene& scene, const Geometry& geometry,
                               const Visibility& visibility);

struct MethodFrame {
  std::vector<Color> colors;
  std::size_t exact_spans = 0;  // that the method left to exact Phong, its own form degenerating
};

// By a shading method that does not refuse the scene (see refusal).
MethodFrame render_method(const Scene& scene, const Geometry& geometry,
                          const Visibility& visibility, const ShadingMethod& method,
                          PowerKind power);

}  // namespace phongpipe
