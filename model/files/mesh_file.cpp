#include "model/files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/files/meshes/mesh_transfer.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

void check_faces(const fs::path& file, const Mesh& mesh) {
  if (mesh.faces.empty()) throw InputError(file, 0, "the mesh has no faces");
  const std::size_t materials = std::max<std::size_t>(mesh.materials.size(), 1);
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (vertex < mesh.positions.size() && face.material < materials) continue;
      throw InputError(file, 0, "a face names a vertex or a material that is not there");
    }
  }
}

void check_positions(const fs::path& file, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    // NaN fails every comparison.
    if (!(mesh.positions[i].array().abs() <= kMaxCoordinate).all()) {
      throw InputError(file, 0,
                       fmt::format("vertex {} is at ({}, {}, {}), must be numbers of at most {}", i,
                                   mesh.positions[i].x(), mesh.positions[i].y(),
                                   mesh.positions[i].z(), kMaxCoordinate));
    }
  }
}

void check_materials(const fs::path& file, const Mesh& mesh) {
  const auto is_color = [](const Color& color) { return ((color >= 0) && (color <= 1)).all(); };
  for (const Material& material : mesh.materials) {
    if (is_color(material.ambient) && is_color(material.diffuse) && is_color(material.specular) &&
        material.shininess >= 0 && std::isfinite(material.shininess)) {
      continue;
    }
    throw InputError(file, 0,
                     fmt::format("material '{}': a color is not from 0 to 1, or the shininess not "
                                 "at least 0",
                                 material.name));
  }
}

void make_normals_unit(const fs::path& file, Mesh& mesh) {
  for (Vec3& normal : mesh.normals) normal = Vec3(normal.stableNormalized());
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (!(std::abs(mesh.normals[vertex].norm() - 1) < 1e-6)) {
        throw InputError(file, 0,
                         fmt::format("the normal of vertex {} is zero or not a number", vertex));
      }
    }
  }
}

void note_reversed_faces(const fs::path& file, Mesh& mesh) {
  const auto reversed = std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const MeshFace& f) {
    const Vec3 sum =
        mesh.normals[f.vertices[0]] + mesh.normals[f.vertices[1]] + mesh.normals[f.vertices[2]];
    return face_area_vector(mesh, f).dot(sum) < 0;
  });
  if (reversed > 0) {
    mesh.notes.push_back(fmt::format("{}: {} of {} faces turn against their normals", file.string(),
                                     reversed, mesh.faces.size()));
  }
}

const char* why_generated(FileNormals normals) {
  switch (normals) {
    case FileNormals::missing:
      return "no normals";
    case FileNormals::partly_missing:
      return "some vertices have no normals";
    case FileNormals::of_facets:
      // Many programs leave them zero, and a surface shaded with them is flat.
      return "only facet normals";
    case FileNormals::given:
      break;
  }
  return nullptr;
}

}  // namespace

Mesh load_mesh(const fs::path& file) {
  ImportedMesh imported = import_mesh(file);
  Mesh mesh = std::move(imported.mesh);
  check_faces(file, mesh);
  check_positions(file, mesh);
  check_materials(file, mesh);
  if (imported.left_out > 0) {
    mesh.notes.push_back(
        fmt::format("{}: {} points and lines left out", file.string(), imported.left_out));
  }
  if (const char* why = why_generated(imported.file_normals)) {
    generate_smooth_normals(mesh, imported.file_normals == FileNormals::partly_missing);
    if (mesh.faces.empty()) {
      throw InputError(file, 0, "all faces of the mesh have zero area");
    }
    mesh.notes.push_back(fmt::format("{}: {}, smooth normals generated", file.string(), why));
  }
  make_normals_unit(file, mesh);
  note_reversed_faces(file, mesh);
  return mesh;
}

}  // namespace phongpipe
