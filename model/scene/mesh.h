// Triangles in three dimensions: what mesh files and primitives are turned into.
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
  std::vector<std::string> notes;   // what a user should know
};

// Positions beyond this are refused, so that no later product overflows.
constexpr double kMaxCoordinate = 1e9;

// Twice the area of a face, along its geometric normal.
Vec3 face_area_vector(const Mesh& mesh, const MeshFace& face);

// Replaces the normals: at each position the area-weighted mean over the faces that meet there,
// also across vertices listed twice. Faces without area are dropped; a corner whose mean vanishes,
// as where two sides of a sheet meet, gets the normal of its own face.
void generate_smooth_normals(Mesh& mesh);

}  // namespace phongpipe
