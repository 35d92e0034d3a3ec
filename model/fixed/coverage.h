// Which pixels a triangle covers: exact integer edge functions and the top-left rule, so that
// triangles sharing an edge cover each pixel once.
#pragma once

#include <vector>

#include "model/fixed/span.h"
#include "model/scene/geometry.h"
#include "model/scene/input_error.h"

namespace phongpipe {

// The non-empty rows of a triangle inside the image, from the top down; `rows` is overwritten. A
// pixel is covered if its centre is inside, or on a top or left edge. The triangle may turn either
// way.
void cover(const ScreenTriangle& triangle, int width, int height, std::vector<RowSpan>& rows);

bool covers_a_pixel(const Scene& scene, const Geometry& geometry);
// The refusal of a scene that does not.
InputError nothing_covered(const Scene& scene);

// Length of the longest row in pixels; `rows` is not empty.
int longest_row(const std::vector<RowSpan>& rows);

// The covered pixel whose centre is nearest to the triangle's centroid; `rows` is not empty.
struct Pixel {
  int x = 0, y = 0;
};
Pixel expansion_pixel(const ScreenTriangle& triangle, const std::vector<RowSpan>& rows);

}  // namespace phongpipe
