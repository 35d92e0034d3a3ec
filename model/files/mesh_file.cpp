#include "model/files/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <utility>

#include "model/files/obj_check.h"
#include "model/files/ply_check.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

using Matrix4 = Eigen::Matrix4d;

Vec3 to_vec3(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

Matrix4 to_matrix(const aiMatrix4x4& m) {
  return Eigen::Map<const Eigen::Matrix<ai_real, 4, 4, Eigen::RowMajor>>(&m.a1).cast<double>();
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Triangulation reads the positions behind the indices, so they are checked before it runs.
void check_indices(const std::filesystem::path& file, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      for (unsigned i = 0; i < mesh.mFaces[f].mNumIndices; ++i) {
        if (mesh.mFaces[f].mIndices[i] >= mesh.mNumVertices) {
          throw InputError(file, 0,
                           fmt::format("face {} of mesh {} refers to vertex {} of {}", f, m,
                                       mesh.mFaces[f].mIndices[i], mesh.mNumVertices));
        }
      }
    }
  }
}

// Properties the file does not give keep the values of the default material. Without a specular
// colour the library makes the shininess up.
Material to_material(const std::filesystem::path& file, const aiMaterial& source, unsigned index) {
  Material material;
  material.name = source.GetName().C_Str();
  if (material.name == AI_DEFAULT_MATERIAL_NAME) {
    return Material{};
  }
  if (material.name.empty()) {
    material.name = fmt::format("{}#{}", file.stem().string(), index);
  }
  const auto read = [&](const char* key, unsigned type, unsigned slot, const char* what,
                        Color& color) {
    aiColor3D value;
    if (source.Get(key, type, slot, value) != AI_SUCCESS) {
      return false;
    }
    color = Color(value.r, value.g, value.b);
    if (!((color >= 0).all() && (color <= 1).all())) {
      throw InputError(file, 0,
                       fmt::format("material '{}': {} color is [{}, {}, {}], must be from 0 to 1",
                                   material.name, what, value.r, value.g, value.b));
    }
    return true;
  };
  read(AI_MATKEY_COLOR_AMBIENT, "ambient", material.ambient);
  read(AI_MATKEY_COLOR_DIFFUSE, "diffuse", material.diffuse);
  ai_real shininess = 0;
  if (read(AI_MATKEY_COLOR_SPECULAR, "specular", material.specular) &&
      source.Get(AI_MATKEY_SHININESS, shininess) == AI_SUCCESS) {
    material.shininess = static_cast<double>(shininess);
    if (!(material.shininess >= 0 && std::isfinite(material.shininess))) {
      throw InputError(file, 0,
                       fmt::format("material '{}': shininess is {}, must be at least 0",
                                   material.name, material.shininess));
    }
  }
  return material;
}

class MeshBuilder {
 public:
  MeshBuilder(const std::filesystem::path& file, const aiScene& scene)
      : file_(file), scene_(scene) {}

  Mesh build() {
    append_node(*scene_.mRootNode, Matrix4::Identity());
    if (skipped_ > 0) {
      mesh_.notes.push_back(
          fmt::format("{}: {} points and lines left out", file_.string(), skipped_));
    }
    return std::move(mesh_);
  }
  bool normals_missing() const { return normals_missing_; }

 private:
  void append_node(const aiNode& node, const Matrix4& parent) {
    const Matrix4 transform = parent * to_matrix(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      append_mesh(*scene_.mMeshes[node.mMeshes[i]], transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      append_node(*node.mChildren[i], transform);
    }
  }

  void append_mesh(const aiMesh& source, const Matrix4& transform) {
    const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
    const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
    const Vec3 translation = transform.topRightCorner<3, 1>();
    const double determinant = linear.determinant();
    // Normals of a scaled surface turn the other way from its points.
    const Eigen::Matrix3d normal_matrix = linear.inverse().transpose();
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      mesh_.positions.emplace_back(linear * to_vec3(source.mVertices[i]) + translation);
      mesh_.normals.emplace_back(
          source.HasNormals() ? Vec3((normal_matrix * to_vec3(source.mNormals[i])).normalized())
                              : Vec3::Zero());
    }
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      const aiFace& face = source.mFaces[f];
      if (face.mNumIndices != 3) {
        ++skipped_;
        continue;
      }
      MeshFace triangle{{base + face.mIndices[0], base + face.mIndices[1], base + face.mIndices[2]},
                        source.mMaterialIndex};
      if (determinant < 0) {  // a mirror image turns the other way
        std::swap(triangle.vertices[1], triangle.vertices[2]);
      }
      mesh_.faces.push_back(triangle);
    }
    normals_missing_ = normals_missing_ || !source.HasNormals();
  }

  const std::filesystem::path& file_;
  const aiScene& scene_;
  Mesh mesh_;
  std::size_t skipped_ = 0;
  bool normals_missing_ = false;
};

void check_positions(const std::filesystem::path& file, const Mesh& mesh) {
  if (mesh.faces.empty()) {
    throw InputError(file, 0, "the mesh has no faces");
  }
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

void check_normals(const std::filesystem::path& file, const Mesh& mesh) {
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (!(std::abs(mesh.normals[vertex].norm() - 1) < 1e-6)) {
        throw InputError(file, 0,
                         fmt::format("the normal of vertex {} is zero or not a number", vertex));
      }
    }
  }
}

void note_reversed_faces(const std::filesystem::path& file, Mesh& mesh) {
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

}  // namespace

Mesh load_mesh(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  ObjFacts obj;
  if (extension == ".obj") {
    obj = check_obj(file);
  } else if (extension == ".ply") {
    check_ply(file);
  }
  Assimp::Importer importer;
  if (importer.ReadFile(file.string(), 0) == nullptr) {
    std::string reason = importer.GetErrorString();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw InputError(file, 0, fmt::format("cannot be read as a mesh: {}", reason));
  }
  check_indices(file, *importer.GetScene());
  const aiScene& scene = *importer.ApplyPostProcessing(aiProcess_Triangulate);

  MeshBuilder builder(file, scene);
  Mesh mesh = builder.build();
  check_positions(file, mesh);
  // The normals of an STL file belong to its facets, many programs leave them zero, and a surface
  // shaded with them is flat.
  const bool facet_normals = extension == ".stl";
  if (builder.normals_missing() || obj.some_normals_missing || facet_normals) {
    generate_smooth_normals(mesh);
    if (mesh.faces.empty()) {
      throw InputError(file, 0, "all faces of the mesh have zero area");
    }
    mesh.notes.push_back(fmt::format("{}: {}, smooth normals generated", file.string(),
                                     facet_normals ? "only facet normals"
                                     : obj.some_normals_missing && !builder.normals_missing()
                                         ? "some faces have no normals"
                                         : "no normals"));
  }
  check_normals(file, mesh);
  note_reversed_faces(file, mesh);

  // The library makes up materials for formats that have none.
  const bool has_materials =
      extension != ".stl" && extension != ".ply" && obj.missing_libraries.empty();
  for (unsigned i = 0; has_materials && i < scene.mNumMaterials; ++i) {
    mesh.materials.push_back(to_material(file, *scene.mMaterials[i], i));
  }
  mesh.notes.insert(mesh.notes.end(), obj.missing_libraries.begin(), obj.missing_libraries.end());
  return mesh;
}

}  // namespace phongpipe
