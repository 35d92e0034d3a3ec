// A mesh from a file, decoded in a confined child (confined_child.h) that sends plain arrays.
#pragma once

#include <cstdint>
#include <filesystem>

#include "model/files/confined_child.h"
#include "model/files/meshes/imported_mesh.h"
#include "model/files/meshes/mesh_format.h"

namespace phongpipe {

// What the child sends: requests for files, then an error, or the arrays in this order.
enum Kind : std::uint64_t {
  kRequest,
  kError,
  kFacts,
  kPositions,
  kNormals,
  kFaces,
  kMaterialNames,
  kMaterialNumbers,
  kNotes,
};
// What the parent answers to a request.
enum Answer : std::uint64_t { kFile, kNoFile };

// Reads the file, and decodes it in a child. What it returns has sizes within the limits of mesh.h,
// and nothing else that could be relied on. Throws InputError, also where the child dies, takes too
// much memory or time, or sends something else.
ImportedMesh import_mesh(const std::filesystem::path& file);

// The parent's part: answers the child's requests for files, and takes what it sends.
ImportedMesh receive_mesh(ConfinedChild& child, const MeshFormat& format,
                          const std::filesystem::path& file, std::size_t bytes);

}  // namespace phongpipe
