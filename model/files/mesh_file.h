// Meshes from files: OBJ with MTL, PLY, STL, glTF and GLB.
#pragma once

#include <filesystem>

#include "model/scene/mesh.h"

namespace phongpipe {

// Polygons are cut into triangles, node transforms applied and missing normals generated (with a
// note). Files that name no materials leave Mesh::materials empty. Throws InputError for other
// formats, NaN, zero normals, indices out of range, no faces, and anything else that cannot be
// drawn as intended.
//
// The file is decoded in a confined child (confined_child.h), which sends plain arrays. They are
// checked here, whatever the child was meant to check. Other files that the mesh names are read
// here, too: MTL for OBJ, .bin for glTF, and nothing else.
Mesh load_mesh(const std::filesystem::path& file);

}  // namespace phongpipe
