// What the fuzz targets share.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "model/files/meshes/imported_mesh.h"
#include "model/scene/input_error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace phongpipe {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// A reader may refuse what it is given, with an InputError. Anything else that it throws is a
// finding.
template <typename Read>
int survive(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  }
  return 0;
}

// What mesh_file.cpp checks again, and may rely on nobody having to.
inline void check_mesh(const ImportedMesh& imported) {
  const Mesh& mesh = imported.mesh;
  if (mesh.normals.size() != mesh.positions.size()) std::abort();
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (vertex >= mesh.positions.size()) std::abort();
    }
    if (face.material >= mesh.materials.size() && face.material != 0) std::abort();
  }
}

// Reads a mesh, with one other file behind this line.
inline int survive_mesh(ImportedMesh (*read)(const MeshSource&), std::string_view text) {
  constexpr std::string_view kSecondFile = "\n%%%%\n";
  const std::size_t end = text.find(kSecondFile);
  const MeshSource source{"fuzz", text.substr(0, end),
                          [&](const std::string&) -> std::optional<std::string> {
                            if (end == std::string_view::npos) return std::nullopt;
                            return std::string(text.substr(end + kSecondFile.size()));
                          }};
  return survive([&] { check_mesh(read(source)); });
}

// A file with the input, for readers that want one. The same file each time.
inline std::filesystem::path input_file(const std::string& name, std::string_view text) {
  static const std::filesystem::path folder = [] {
    auto made =
        std::filesystem::temp_directory_path() / ("phongpipe-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

}  // namespace phongpipe
