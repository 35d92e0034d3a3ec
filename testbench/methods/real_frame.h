// A whole frame in real arithmetic. Colours are in LSB and not rounded; pixels that are not covered
// have the background colour.
#pragma once

#include <vector>

#include "model/shading/methods/shading_method.h"
#include "testbench/methods/visibility.h"

namespace phongpipe {

// Exact Phong shading of everything the scene format describes.
std::vector<Color> render_phong(const Scene& scene, const Geometry& geometry,
                                const Visibility& visibility);

// The limit of six coefficients per series: the best quadratics replace each light's cosines.
// Powers, attenuation and cones are exact.
std::vector<Color> render_best(const Scene& scene, const Geometry& geometry,
                               const Visibility& visibility);

struct MethodFrame {
  std::vector<Color> colors;
  std::size_t exact_spans = 0;  // shaded by exact Phong, because the method is degenerate there
};

// Shades by a method that does not refuse the scene (see refusal).
MethodFrame render_method(const Scene& scene, const Geometry& geometry,
                          const Visibility& visibility, const ShadingMethod& method,
                          PowerKind power);

}  // namespace phongpipe
