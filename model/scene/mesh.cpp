#include "model/scene/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace phongpipe {
namespace {

// For each vertex the first one, in sorted order, at exactly the same position.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    return std::make_tuple(positions[i].x(), positions[i].y(), positions[i].z());
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

}  // namespace

Vec3 face_area_vector(const Mesh& mesh, const MeshFace& face) {
  const Vec3& origin = mesh.positions[face.vertices[0]];
  return (mesh.positions[face.vertices[1]] - origin)
      .cross(mesh.positions[face.vertices[2]] - origin);
}

void generate_smooth_normals(Mesh& mesh, bool only_missing) {
  mesh.faces.erase(
      std::remove_if(mesh.faces.begin(), mesh.faces.end(),
                     [&](const MeshFace& face) { return face_area_vector(mesh, face).isZero(0); }),
      mesh.faces.end());
  const std::vector<std::uint32_t> first = weld(mesh.positions);
  std::vector<Vec3> sum(mesh.positions.size(), Vec3::Zero());
  std::vector<double> area(mesh.positions.size(), 0.0);
  for (const MeshFace& face : mesh.faces) {
    const Vec3 area_vector = face_area_vector(mesh, face);
    for (const std::uint32_t vertex : face.vertices) {
      sum[first[vertex]] += area_vector;
      area[first[vertex]] += area_vector.norm();
    }
  }
  std::vector<bool> given(mesh.positions.size(), false);
  for (std::size_t i = 0; only_missing && i < given.size(); ++i) {
    given[i] = !mesh.normals[i].isZero(0);
  }
  mesh.normals.resize(mesh.positions.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i]) mesh.normals[i] = Vec3::UnitY();  // unused vertices keep this one
  }
  for (MeshFace& face : mesh.faces) {
    for (std::uint32_t& vertex : face.vertices) {
      if (given[vertex]) continue;
      const std::uint32_t shared = first[vertex];
      if (sum[shared].norm() > 1e-9 * area[shared]) {
        mesh.normals[vertex] = sum[shared].normalized();
        continue;
      }
      mesh.positions.push_back(Vec3(mesh.positions[vertex]));
      mesh.normals.push_back(face_area_vector(mesh, face).normalized());
      vertex = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    }
  }
}

}  // namespace phongpipe
