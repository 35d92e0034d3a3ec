#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <set>

#include "model/files/meshes/gltf_document.h"
#include "model/files/scene_values.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

using Json = GltfDocument::Json;
using Matrix4 = Eigen::Matrix4d;

class GltfReader {
 public:
  explicit GltfReader(const MeshSource& source) : source_(source), document_(source) {}

  ImportedMesh run() {
    read_materials();
    draw_scene();
    if (!has_normals_) imported_.file_normals = FileNormals::missing;
    left_out_.insert(document_.left_out().begin(), document_.left_out().end());
    if (!left_out_.empty()) {
      note(
          fmt::format("left out: {}", excerpt(fmt::format("{}", fmt::join(left_out_, ", ")), 500)));
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

  void read_materials() {
    for (const Json& source : document_.list("materials")) {
      const std::size_t index = imported_.mesh.materials.size();
      if (index == kMaxMeshMaterials) {
        throw MeshFault(fmt::format("a mesh may have at most {} materials", kMaxMeshMaterials));
      }
      Material& material = imported_.mesh.materials.emplace_back();
      material.name = GltfDocument::text(source, "name");
      if (material.name.empty()) {
        material.name = fmt::format("{}#{}", source_.file.stem().string(), index);
      }
      try {
        read_material(source, material);
      } catch (const MeshFault& fault) {
        throw MeshFault(fmt::format("material {}: {}", index, fault.what()));
      }
    }
  }

  void read_material(const Json& source, Material& material) {
    const std::string mode = GltfDocument::text(source, "alphaMode");
    if (mode != "" && mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
      throw MeshFault(
          fmt::format("alphaMode is '{}', must be OPAQUE, MASK or BLEND", excerpt(mode)));
    }
    if (mode == "MASK" || mode == "BLEND") left_out_.emplace("transparency");
    for (const char* texture : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
      if (source.contains(texture)) left_out_.emplace("textures");
    }
    if (const auto emission = source.find("emissiveFactor"); emission != source.end()) {
      const auto factors = GltfDocument::numbers(*emission, "emissiveFactor", 3);
      if (factors != std::vector<double>(3, 0.0)) left_out_.emplace("emission");
    }
    const auto pbr = source.find("pbrMetallicRoughness");
    if (pbr == source.end()) return;
    if (!pbr->is_object()) throw MeshFault("'pbrMetallicRoughness' must be an object");
    for (const char* texture : {"baseColorTexture", "metallicRoughnessTexture"}) {
      if (pbr->contains(texture)) left_out_.emplace("textures");
    }
    const auto color = pbr->find("baseColorFactor");
    if (color == pbr->end()) return;
    const auto rgba = GltfDocument::numbers(*color, "baseColorFactor", 4);
    material.diffuse = Color(rgba[0], rgba[1], rgba[2]);
    if (!((material.diffuse >= 0).all() && (material.diffuse <= 1).all())) {
      throw MeshFault(fmt::format("baseColorFactor is [{}, {}, {}], must be from 0 to 1", rgba[0],
                                  rgba[1], rgba[2]));
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
    for (const Json& item : *found) nodes.push_back(document_.reference_of(item, key, "nodes"));
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
      Matrix4 matrix = Eigen::Map<const Matrix4>(whole.data());
      if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
        throw MeshFault("its matrix is a projection: the last row must be 0 0 0 1");
      }
      return matrix;
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
    // What a transform shrinks to a line or a point is hidden.
    const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
    if (linear.col(0).cross(linear.col(1)).isZero(0) &&
        linear.col(1).cross(linear.col(2)).isZero(0) &&
        linear.col(2).cross(linear.col(0)).isZero(0)) {
      return;
    }
    const std::size_t first_vertex = imported_.mesh.positions.size();
    add_vertices(positions, document_.reference(*attributes, "NORMAL", "accessors"), transform);
    const std::vector<std::uint32_t> corners =
        corners_of(document_.reference(primitive, "indices", "accessors"), first_vertex);
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
    if (linear.determinant() >= 0) return;
    for (std::size_t i = first_face; i < imported_.mesh.faces.size(); ++i) {
      // A mirror image turns the other way.
      std::swap(imported_.mesh.faces[i].vertices[1], imported_.mesh.faces[i].vertices[2]);
    }
  }

  void add_vertices(std::ptrdiff_t position_accessor, std::ptrdiff_t normal_accessor,
                    const Matrix4& transform) {
    const std::vector<double> positions = document_.vectors(position_accessor);
    std::vector<double> normals;
    if (normal_accessor >= 0) {
      normals = document_.vectors(normal_accessor);
      if (normals.size() != positions.size()) {
        throw MeshFault(fmt::format("it has {} positions, but {} normals", positions.size() / 3,
                                    normals.size() / 3));
      }
    }
    const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
    const Vec3 translation = transform.topRightCorner<3, 1>();
    // Normals of a scaled surface turn the other way from its points; of a flattened one they
    // cannot be told from its points'.
    const bool normals_hold = !normals.empty() && linear.determinant() != 0;
    if (!normals_hold) imported_.file_normals = FileNormals::partly_missing;
    has_normals_ = has_normals_ || normals_hold;
    const Eigen::Matrix3d normal_matrix =
        normals_hold ? Eigen::Matrix3d(linear.inverse().transpose()) : Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < positions.size(); i += 3) {
      imported_.add_vertex(
          linear * Vec3(positions[i], positions[i + 1], positions[i + 2]) + translation,
          normals_hold ? Vec3(normal_matrix * Vec3(normals[i], normals[i + 1], normals[i + 2]))
                       : Vec3::Zero());
    }
  }

  // The vertices from `first` on that the indices name, or all where there are no indices (-1).
  std::vector<std::uint32_t> corners_of(std::ptrdiff_t index_accessor, std::size_t first) const {
    const std::size_t count = imported_.mesh.positions.size() - first;
    std::vector<std::uint32_t> corners;
    if (index_accessor < 0) {
      corners.resize(count);
      std::iota(corners.begin(), corners.end(), static_cast<std::uint32_t>(first));
      return corners;
    }
    const std::vector<double> indices = document_.indices(index_accessor);
    corners.reserve(indices.size());
    for (const double index : indices) {
      if (index >= static_cast<double>(count)) {
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
