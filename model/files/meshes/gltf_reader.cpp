#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "model/files/meshes/gltf_document.h"
#include "model/files/scene_values.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

using Json = GltfDocument::Json;
using Matrix4 = Eigen::Matrix4d;

// Extensions that a file may require, since they do not change where its points are.
constexpr std::array<std::string_view, 5> kHarmlessExtensions = {
    "KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_punctual",
    "KHR_mesh_quantization"};

class GltfReader {
 public:
  explicit GltfReader(const MeshSource& source) : source_(source), document_(source) {}

  ImportedMesh run() {
    check_extensions();
    read_materials();
    draw_scene();
    if (!has_normals_) imported_.file_normals = FileNormals::missing;
    if (!left_out_.empty()) {
      note(fmt::format("left out: {}", fmt::join(left_out_, ", ")));
    }
    return std::move(imported_);
  }

 private:
  struct Placed {
    std::ptrdiff_t node;
    Matrix4 parent;
  };

  void note(const std::string& text) {
    imported_.mesh.notes.push_back(fmt::format("{}: {}", source_.file.string(), text));
  }

  void check_extensions() const {
    const auto required = document_.root().find("extensionsRequired");
    if (required == document_.root().end()) return;
    if (!required->is_array()) throw MeshFault("'extensionsRequired' must be an array");
    for (const Json& name : *required) {
      const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
      if (std::none_of(kHarmlessExtensions.begin(), kHarmlessExtensions.end(),
                       [&](std::string_view prefix) { return text.rfind(prefix, 0) == 0; })) {
        throw MeshFault(
            fmt::format("it requires the extension {}, which is not supported", excerpt(text)));
      }
    }
  }

  void read_materials() {
    for (const Json& source : document_.list("materials")) {
      const std::size_t index = imported_.mesh.materials.size();
      Material& material = imported_.mesh.materials.emplace_back();
      material.name = GltfDocument::text(source, "name");
      if (material.name.empty()) {
        material.name = fmt::format("{}#{}", source_.file.stem().string(), index);
      }
      for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
        if (source.contains(texture)) left_out_.emplace("textures");
      }
      const auto pbr = source.find("pbrMetallicRoughness");
      if (pbr == source.end()) continue;
      if (!pbr->is_object()) throw MeshFault("'pbrMetallicRoughness' must be an object");
      if (pbr->contains("baseColorTexture")) left_out_.emplace("textures");
      const auto color = pbr->find("baseColorFactor");
      if (color == pbr->end()) continue;
      const auto rgba = GltfDocument::numbers(*color, "baseColorFactor", 4);
      material.diffuse = Color(rgba[0], rgba[1], rgba[2]);
      if (!((material.diffuse >= 0).all() && (material.diffuse <= 1).all())) {
        throw MeshFault(
            fmt::format("material {}: baseColorFactor is [{}, {}, {}], must be from 0 "
                        "to 1",
                        index, rgba[0], rgba[1], rgba[2]));
      }
    }
  }

  // All nodes of the scene, without recursion: they may be nested as deep as the file likes.
  void draw_scene() {
    std::vector<Placed> waiting;
    for (const std::ptrdiff_t node : root_nodes()) waiting.push_back({node, Matrix4::Identity()});
    std::vector<bool> seen(document_.list("nodes").size(), false);
    while (!waiting.empty()) {
      const Placed placed = waiting.back();
      waiting.pop_back();
      const auto index = static_cast<std::size_t>(placed.node);
      if (seen[index]) throw MeshFault(fmt::format("node {} has more than one parent", index));
      seen[index] = true;
      const Json& node = document_.list("nodes")[index];
      try {
        const Matrix4 transform = placed.parent * matrix(node);
        draw_mesh(node, transform);
        const std::vector<std::ptrdiff_t> children = node_list(node, "children");
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
          waiting.push_back({*child, transform});
        }
      } catch (const MeshFault& fault) {
        throw MeshFault(fmt::format("node {}: {}", index, fault.what()));
      }
    }
  }

  // Of the scene that is shown, or of the first, or all without a parent where there is none.
  std::vector<std::ptrdiff_t> root_nodes() {
    const Json& scenes = document_.list("scenes");
    const std::ptrdiff_t shown = document_.reference(document_.root(), "scene", "scenes");
    if (shown >= 0) return node_list(scenes[static_cast<std::size_t>(shown)], "nodes");
    if (!scenes.empty()) {
      if (scenes.size() > 1) note(fmt::format("the first of {} scenes is shown", scenes.size()));
      return node_list(scenes[0], "nodes");
    }
    note("it has no scene, all its nodes are shown");
    const Json& nodes = document_.list("nodes");
    std::vector<bool> is_child(nodes.size(), false);
    for (const Json& node : nodes) {
      for (const std::ptrdiff_t child : node_list(node, "children")) {
        is_child[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<std::ptrdiff_t> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(static_cast<std::ptrdiff_t>(i));
    }
    return roots;
  }

  std::vector<std::ptrdiff_t> node_list(const Json& owner, const char* key) const {
    std::vector<std::ptrdiff_t> nodes;
    const auto found = owner.find(key);
    if (found == owner.end()) return nodes;
    if (!found->is_array()) throw MeshFault(fmt::format("'{}' must be an array", key));
    for (const Json& item : *found)
      nodes.push_back(document_.reference({{key, item}}, key, "nodes"));
    return nodes;
  }

  static Matrix4 matrix(const Json& node) {
    const auto given = [&](const char* key, std::size_t count) {
      const auto found = node.find(key);
      return found == node.end() ? std::vector<double>()
                                 : GltfDocument::numbers(*found, key, count);
    };
    const auto whole = given("matrix", 16), move = given("translation", 3),
               turn = given("rotation", 4), scale = given("scale", 3);
    if (!whole.empty()) {
      if (!move.empty() || !turn.empty() || !scale.empty()) {
        throw MeshFault("it has a matrix and also translation, rotation or scale");
      }
      return Eigen::Map<const Matrix4>(whole.data());
    }
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (!move.empty()) transform.translate(Vec3(move[0], move[1], move[2]));
    if (!turn.empty()) {
      const Eigen::Quaterniond rotation(turn[3], turn[0], turn[1], turn[2]);
      if (rotation.norm() < kShortestVector) throw MeshFault("its rotation is zero");
      transform.rotate(rotation.normalized());
    }
    if (!scale.empty()) transform.scale(Vec3(scale[0], scale[1], scale[2]));
    return transform.matrix();
  }

  void draw_mesh(const Json& node, const Matrix4& transform) {
    const std::ptrdiff_t mesh = document_.reference(node, "mesh", "meshes");
    if (mesh < 0) return;
    if (node.contains("skin")) left_out_.emplace("skins");
    const Json& primitives =
        GltfDocument::list(document_.list("meshes")[static_cast<std::size_t>(mesh)], "primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      try {
        draw_primitive(primitives[i], transform);
      } catch (const MeshFault& fault) {
        throw MeshFault(fmt::format("mesh {}, primitive {}: {}", mesh, i, fault.what()));
      }
    }
  }

  void draw_primitive(const Json& primitive, const Matrix4& transform) {
    enum Mode { triangles = 4, strip = 5, fan = 6 };
    const std::size_t mode = GltfDocument::whole(primitive, "mode", fan, triangles);
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) {
      throw MeshFault("it has no 'attributes'");
    }
    if (attributes->contains("COLOR_0")) left_out_.emplace("colors of vertices");
    if (primitive.contains("targets")) left_out_.emplace("morph targets");
    if (mode < triangles) {
      ++imported_.left_out;
      return;
    }
    const std::ptrdiff_t positions = document_.reference(*attributes, "POSITION", "accessors");
    if (positions < 0) throw MeshFault("it has no positions");
    const std::vector<std::uint32_t> corners =
        add_vertices(positions, document_.reference(*attributes, "NORMAL", "accessors"), transform,
                     document_.reference(primitive, "indices", "accessors"));
    const std::uint32_t material = material_of(primitive);
    const std::size_t first_face = imported_.mesh.faces.size();
    if (mode == strip) {
      imported_.add_strip(corners, material);
    } else if (mode == fan) {
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        imported_.add_triangle(corners[0], corners[i], corners[i + 1], material);
      }
    } else {
      if (corners.size() % 3 != 0) {
        throw MeshFault(fmt::format("its triangles have {} corners in all, must be a multiple of 3",
                                    corners.size()));
      }
      for (std::size_t i = 0; i < corners.size(); i += 3) {
        imported_.add_triangle(corners[i], corners[i + 1], corners[i + 2], material);
      }
    }
    if (transform.topLeftCorner<3, 3>().determinant() >= 0) return;
    for (std::size_t i = first_face; i < imported_.mesh.faces.size(); ++i) {
      // A mirror image turns the other way.
      std::swap(imported_.mesh.faces[i].vertices[1], imported_.mesh.faces[i].vertices[2]);
    }
  }

  // Returns the vertices that the indices name, or all where there are no indices (-1).
  std::vector<std::uint32_t> add_vertices(std::ptrdiff_t position_accessor,
                                          std::ptrdiff_t normal_accessor, const Matrix4& transform,
                                          std::ptrdiff_t index_accessor) {
    const std::vector<double> positions =
        document_.accessor(position_accessor, "VEC3", kMaxMeshVertices);
    std::vector<double> normals;
    if (normal_accessor >= 0) {
      normals = document_.accessor(normal_accessor, "VEC3", kMaxMeshVertices);
      if (normals.size() != positions.size()) {
        throw MeshFault(fmt::format("it has {} positions, but {} normals", positions.size() / 3,
                                    normals.size() / 3));
      }
    }
    const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
    const Vec3 translation = transform.topRightCorner<3, 1>();
    const double determinant = linear.determinant();
    // Normals of a scaled surface turn the other way from its points; of a flattened one they
    // cannot be told from its points'.
    const bool normals_hold = !normals.empty() && determinant != 0;
    if (!normals_hold) imported_.file_normals = FileNormals::partly_missing;
    has_normals_ = has_normals_ || normals_hold;
    const Eigen::Matrix3d normal_matrix =
        normals_hold ? Eigen::Matrix3d(linear.inverse().transpose()) : Eigen::Matrix3d::Zero();
    const std::size_t first = imported_.mesh.positions.size();
    for (std::size_t i = 0; i < positions.size(); i += 3) {
      imported_.add_vertex(
          linear * Vec3(positions[i], positions[i + 1], positions[i + 2]) + translation,
          normals_hold ? Vec3(normal_matrix * Vec3(normals[i], normals[i + 1], normals[i + 2]))
                       : Vec3::Zero());
    }
    std::vector<std::uint32_t> corners;
    if (index_accessor < 0) {
      for (std::size_t i = first; i < imported_.mesh.positions.size(); ++i) {
        corners.push_back(static_cast<std::uint32_t>(i));
      }
      return corners;
    }
    const std::size_t count = imported_.mesh.positions.size() - first;
    for (const double index : document_.accessor(index_accessor, "SCALAR", 3 * kMaxMeshTriangles)) {
      if (!(index >= 0 && index < static_cast<double>(count) && index == std::floor(index))) {
        throw MeshFault(fmt::format("an index is {}, but there are {} vertices", index, count));
      }
      corners.push_back(static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(index));
    }
    return corners;
  }

  // A primitive without a material gets the default one, behind those of the file.
  std::uint32_t material_of(const Json& primitive) {
    const std::ptrdiff_t material = document_.reference(primitive, "material", "materials");
    if (material >= 0) return static_cast<std::uint32_t>(material);
    const std::size_t in_file = document_.list("materials").size();
    if (in_file > 0 && imported_.mesh.materials.size() == in_file) {
      imported_.mesh.materials.emplace_back();
    }
    return static_cast<std::uint32_t>(in_file);
  }

  const MeshSource& source_;
  const GltfDocument document_;
  ImportedMesh imported_;
  bool has_normals_ = false;
  std::set<std::string> left_out_;
};

}  // namespace

ImportedMesh read_gltf(const MeshSource& source) {
  try {
    return GltfReader(source).run();
  } catch (const MeshFault& fault) {
    throw InputError(source.file, 0, fault.what());
  }
}

}  // namespace phongpipe
