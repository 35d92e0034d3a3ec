// Triangle mesh in three dimensions, read from a file or made from a primitive.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

struct MeshFace {
  std::array<std::uint32_t, 3> vertices;  // counter-clockwise seen from the outside
  std::uint32_t material = 0;             // index into Mesh::materials
};

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // unit, one for each position
  std::vector<MeshFace> faces;
  std::vector<Material> materials;  // empty: the mesh names none
  std::vector<std::string> notes;   // messages for the user
};

// Largest coordinate accepted, by magnitude, so that no later product overflows.
constexpr double kMaxCoordinate = 1e9;
// Sizes beyond these are refused: a frame of so many triangles takes gigabytes and minutes.
constexpr std::size_t kMaxMeshVertices = std::size_t{1} << 22;
constexpr std::size_t kMaxMeshTriangles = std::size_t{1} << 22;
constexpr std::size_t kMaxMeshMaterials = std::size_t{1} << 16;

// Vector along the geometric normal of a face; its length is twice the area of the face.
Vec3 face_area_vector(const Mesh& mesh, const MeshFace& face);

// Replaces each normal by the area-weighted mean of the normals of all faces that meet at its
// position, across duplicate vertices too. Removes faces of zero area. Where the mean vanishes,
// such as where two sides of a sheet meet, a corner gets the normal of its own face.
// `only_missing`: normals that are not zero stay.
void generate_smooth_normals(Mesh& mesh, bool only_missing = false);

}  // namespace phongpipe
