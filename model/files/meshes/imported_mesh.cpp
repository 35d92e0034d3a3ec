#include "model/files/meshes/imported_mesh.h"

#include <fmt/format.h>

#include "model/files/meshes/polygon.h"

namespace phongpipe {

std::uint32_t ImportedMesh::add_vertex(const Vec3& position, const Vec3& normal) {
  if (mesh.positions.size() == kMaxMeshVertices) {
    throw MeshFault(fmt::format("a mesh may have at most {} vertices", kMaxMeshVertices));
  }
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void ImportedMesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                std::uint32_t material) {
  if (mesh.faces.size() == kMaxMeshTriangles) {
    throw MeshFault(fmt::format("a mesh may have at most {} triangles", kMaxMeshTriangles));
  }
  mesh.faces.push_back({{a, b, c}, material});
}

void ImportedMesh::add_polygon(const std::vector<std::uint32_t>& corners, std::uint32_t material) {
  if (corners.size() < 3) {
    ++left_out;
    return;
  }
  if (corners.size() == 3) return add_triangle(corners[0], corners[1], corners[2], material);
  if (corners.size() > kMaxPolygonCorners) {
    throw MeshFault(fmt::format("the face has {} corners, may have at most {}", corners.size(),
                                kMaxPolygonCorners));
  }
  std::vector<Vec3> positions;
  positions.reserve(corners.size());
  for (const std::uint32_t corner : corners) positions.emplace_back(mesh.positions[corner]);
  const auto triangles = cut_polygon(positions);
  if (!triangles) {
    throw MeshFault(
        fmt::format("the outline of the face with {} corners crosses itself", corners.size()));
  }
  for (const auto& [a, b, c] : *triangles) {
    add_triangle(corners[a], corners[b], corners[c], material);
  }
}

void ImportedMesh::add_strip(const std::vector<std::uint32_t>& corners, std::uint32_t material) {
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    const std::size_t odd = i % 2;
    add_triangle(corners[i], corners[i + 1 + odd], corners[i + 2 - odd], material);
  }
}

}  // namespace phongpipe
