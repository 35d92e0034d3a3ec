// What the readers of mesh files are given and what they make of it. They run in a confined child
// (mesh_transfer.cpp) and touch no file themselves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/scene/mesh.h"

namespace phongpipe {

struct MeshSource {
  std::filesystem::path file;  // what messages call it
  std::string_view bytes;      // all of it
  // The contents of a file that `bytes` names, relative to its folder; nothing if there is none.
  std::function<std::optional<std::string>(const std::string& name)> open;
};

// An error whose place, file and line, the reader adds.
class MeshFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class FileNormals { given, missing, partly_missing, of_facets };

// A mesh as its file gives it: the normals are not unit yet, and zero unless `file_normals` is
// given.
struct ImportedMesh {
  Mesh mesh;
  FileNormals file_normals = FileNormals::given;
  std::size_t left_out = 0;  // points, lines, and faces of fewer than three corners

  // Returns the vertex's index. Throws MeshFault beyond kMaxMeshVertices.
  std::uint32_t add_vertex(const Vec3& position, const Vec3& normal);
  // Cuts the polygon into triangles. Throws MeshFault beyond kMaxMeshTriangles, or where the
  // outline crosses itself.
  void add_polygon(const std::vector<std::uint32_t>& corners, std::uint32_t material);
  // Triangle i of a strip goes the other way round if i is odd.
  void add_strip(const std::vector<std::uint32_t>& corners, std::uint32_t material);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material);
};

ImportedMesh read_obj(const MeshSource& source);   // OBJ with MTL
ImportedMesh read_ply(const MeshSource& source);   // ASCII and binary
ImportedMesh read_stl(const MeshSource& source);   // ASCII and binary
ImportedMesh read_gltf(const MeshSource& source);  // glTF 2.0 and GLB

}  // namespace phongpipe
