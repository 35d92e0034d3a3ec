// The formats that meshes are read from, by the ends of their names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/files/meshes/imported_mesh.h"

namespace phongpipe {

struct MeshFormat {
  std::vector<std::string> extensions;  // in lower case, with the dot
  ImportedMesh (*read)(const MeshSource&);
  std::vector<std::string> companions;  // extensions of the files that it may name
};

bool is_mesh(const std::filesystem::path& file);

// Throws InputError for other extensions.
const MeshFormat& mesh_format_of(const std::filesystem::path& file);

// In upper or lower case.
bool has_extension_of(const std::filesystem::path& file,
                      const std::vector<std::string>& extensions);

}  // namespace phongpipe
