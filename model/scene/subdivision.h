// Subdivision, before setup, of triangles whose vectors turn too sharply for one quadratic.
#pragma once

#include <functional>

#include "model/scene/geometry.h"

namespace phongpipe {

struct Subdivision {
  Geometry geometry;                 // with the pieces in place of the triangles that were split
  std::vector<std::uint32_t> whole;  // for each triangle of `geometry`, the index of its original
  std::size_t split = 0;             // number of original triangles that were split
  std::size_t pieces = 0;            // number of pieces they became
};

// Splits each triangle that turns too sharply into four at the midpoints of its edges, and these
// again, up to kSubdivisionLevels deep. A triangle turns too sharply if, between two of its
// corners,
// - the normals turn by more than `largest_turn_degrees`; or
// - where a highlight falls on the triangle, the normals and halfway vectors together turn by more
//   than the angle from the middle of the highlight to where it fades below 1/255; or
// - the directions to a point or spot light turn by more than half of `largest_turn_degrees`, or,
//   in a cone that fades, by more than a third of the angle at which its power fades below 1/255.
// `largest_turn_degrees` = 0 splits nothing.
//
// Midpoints are plain averages, not normalised, and exact on the screen. So interpolated vectors,
// and with them exact Phong shading, are the same on the pieces as on the whole triangle. The
// pieces cover the pixels of the triangle, each once, whether or not a neighbour is split too.
Subdivision subdivide(const Scene& scene, const Geometry& geometry, int largest_turn_degrees);

// The same for triangles that `wants` names, given how many levels may still follow.
using WantsSplit = std::function<bool(const ScreenTriangle& triangle, int levels)>;
Subdivision subdivide(const Geometry& geometry, const WantsSplit& wants);

}  // namespace phongpipe
