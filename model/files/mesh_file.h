// Meshes from files: OBJ with MTL, PLY, STL, glTF and whatever else the mesh library reads.
#pragma once

#include <filesystem>

#include "model/scene/mesh.h"

namespace phongpipe {

// Polygons are cut into triangles, node transforms applied and missing normals generated (with a
// note). Files that name no materials leave Mesh::materials empty. Throws InputError for NaN, zero
// normals, indices out of range, no faces, and anything else that cannot be drawn as intended.
Mesh load_mesh(const std::filesystem::path& file);

}  // namespace phongpipe
