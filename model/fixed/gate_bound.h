// Whether the diffuse series can open and close the highlight's gate.
#pragma once

#include "model/fixed/datapath_configuration.h"
#include "model/scene/geometry.h"

namespace phongpipe {

// What the gate must tell apart from N·L = 0: 0.9° from the terminator.
constexpr double kGateTolerance = 1.0 / 64;

// Whether rounded diffuse coefficients may take the wrong sign where N·L is more than
// kGateTolerance from 0, on some triangle of the material that comes near the terminator under the
// light. Such a highlight needs the series of N·L, whose scale does not depend on the material.
// `material`: one of the geometry's.
//
// A series of scale s (LSB for N·L = 1) is off by at most rounding_bound() LSB, so its sign is
// right wherever |N·L| > rounding_bound() / s. Fading with distance is left out: it fades the
// highlight that the gate opens, too.
bool diffuse_loses_sign(const FixedPointFormats& formats, const Scene& scene,
                        const Geometry& geometry, const Material& material, const Light& light);

}  // namespace phongpipe
