#include "model/files/meshes/mesh_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace fs = std::filesystem;

static const std::vector<MeshFormat>& mesh_formats() {
  static const std::vector<MeshFormat> formats = {
      {{".obj"}, read_obj, {".mtl"}},
      {{".ply"}, read_ply, {}},
      {{".stl"}, read_stl, {}},
      {{".gltf", ".glb"}, read_gltf, {".bin", ".glbin", ".glbuf"}},
  };
  return formats;
}

bool is_mesh(const fs::path& file) {
  return std::any_of(mesh_formats().begin(), mesh_formats().end(), [&](const MeshFormat& format) {
    return has_extension_of(file, format.extensions);
  });
}

const MeshFormat& mesh_format_of(const fs::path& file) {
  std::vector<std::string> known;
  for (const MeshFormat& format : mesh_formats()) {
    if (has_extension_of(file, format.extensions)) return format;
    known.insert(known.end(), format.extensions.begin(), format.extensions.end());
  }
  throw InputError(file, 0,
                   fmt::format("meshes are read from files that end with {}; convert it to one of "
                               "these",
                               fmt::join(known, ", ")));
}

bool has_extension_of(const fs::path& file, const std::vector<std::string>& extensions) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

}  // namespace phongpipe
