// A whole frame in real arithmetic. Colours are in LSB and not rounded; the background stands where
// nothing is covered.
#pragma once

#include <vector>

#include "model/fixed/frame_setup.h"

namespace phongpipe {

// Exact Phong shading of everything the scene format describes; depth test in double precision.
std::vector<Color> render_phong(const Scene& scene, const Geometry& geometry);

// The paper's second-degree series with exact powers, gated and hidden as the pipeline does it.
std::vector<Color> render_taylor(const Scene& scene, const Geometry& geometry,
                                 const FrameSetup& frame);

}  // namespace phongpipe
