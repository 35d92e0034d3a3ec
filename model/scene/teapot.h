// Newell's teapot from its 32 bicubic Bézier patches, with the exact normals of the patches.
#pragma once

#include <array>
#include <cstddef>

#include "model/scene/mesh.h"

namespace phongpipe {

// Segments count within each patch: around the pot (or across spout and handle), and along the
// profile. Quads at the two poles give one triangle.
Mesh make_teapot(std::array<int, 2> segments);
std::size_t teapot_triangles(std::array<int, 2> segments);

}  // namespace phongpipe
