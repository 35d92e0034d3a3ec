// The shapes a scene can name without a mesh file: sphere, torus, plane, pawn, teapot.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "model/scene/mesh.h"

namespace phongpipe {

using Segments = std::array<int, 2>;  // around the y axis, and along the profile

struct Primitive {
  const char* name;
  Segments default_segments;
  Segments min_segments;
  std::size_t (*triangles)(Segments);  // number that make() emits; none has zero area
  Mesh (*make)(Segments);
};

// sphere  radius 1 about the origin
// torus   around the y axis, radii 1 and 0.4
// plane   2 by 2 about the origin, facing +y; segments along x and z
// pawn    a chess pawn 2 high, standing on y = 0; by default 14,620 triangles, as many as the
//         paper's frame. It ends in rings too small to see instead of poles, so each of the
//         around × along quads gives two triangles. The base is open.
// teapot  Newell's, in his units: 3.15 high, standing on y = 0, the spout towards +x; segments
//         are counted within each of its 32 patches
const std::vector<Primitive>& primitives();

// Null when there is no primitive of that name.
const Primitive* find_primitive(const std::string& name);

}  // namespace phongpipe
