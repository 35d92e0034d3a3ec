// Where the cone of a spotlight ends. What is outside is a span of its own, without the light's
// series: the edge is as sharp as the exact shading's, and costs no pixel hardware.
#pragma once

#include <vector>

#include "model/fixed/span.h"
#include "model/scene/geometry.h"

namespace phongpipe {

// Splits the rows of a triangle into pieces inside and outside the cone of `light`, whose vector is
// interpolated linearly as in exact Phong shading and looked at in pixel centres. A cone is convex:
// where all corners are inside, all is, and a row has one lit piece at most.
void split_at_cone(const Light& light, const ScreenTriangle& triangle, std::vector<RowSpan>& rows);

}  // namespace phongpipe
