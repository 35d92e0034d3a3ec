// The edge of a spotlight's cone. Pixels outside are separate spans without the light's series, so
// the edge is as sharp as in exact shading and costs no pixel hardware.
#pragma once

#include <vector>

#include "model/fixed/span.h"
#include "model/scene/geometry.h"

namespace phongpipe {

// Splits the rows of a triangle into pieces inside and outside the cone of `light`. The light
// vector is interpolated linearly, as in exact Phong shading, and tested at pixel centres. A cone
// is convex: a triangle with all corners inside is inside, and a row has at most one lit piece.
void split_at_cone(const Light& light, const ScreenTriangle& triangle, std::vector<RowSpan>& rows);

}  // namespace phongpipe
