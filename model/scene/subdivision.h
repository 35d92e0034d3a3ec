// Triangles that turn too sharply for one quadratic, cut up before they are set up.
#pragma once

#include "model/scene/geometry.h"

namespace phongpipe {

struct Subdivision {
  Geometry geometry;                 // the pieces in place of the triangles that were split
  std::vector<std::uint32_t> whole;  // of each piece, the triangle it is a part of
  std::size_t split = 0;             // triangles that were
  std::size_t pieces = 0;            // that these became
};

// Splits a triangle by the middles of its edges into four where two normals of its corners are more
// than `largest_turn_degrees` apart, or, if a highlight falls on it, normals and halfway vectors
// together than the highlight reaches from its middle before it fades below 1 of 255; under a light
// close by, also where its directions are more than half the limit apart, or within a cone more
// than a third of what the cone's power reaches. The four again, up to kSubdivisionLevels deep. 0:
// none.
//
// Middles are plain averages, not made unit, and exact on the screen. So what is interpolated over
// the pieces, and with it exact Phong shading, is what it was over the whole; and the pieces cover
// its pixels, each once, whether or not a neighbour is split too.
Subdivision subdivide(const Scene& scene, const Geometry& geometry, int largest_turn_degrees);

}  // namespace phongpipe
