#include "model/scene/geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/scene/clip.h"
#include "model/scene/mesh.h"
#include "model/scene/primitives.h"
#include "model/scene/projection.h"

namespace phongpipe {
namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

enum class Fate { kept, back_facing, outside, degenerate };

Eigen::Affine3d object_transform(const Object& object) {
  const Vec3 angles = object.rotate_degrees * kRadiansPerDegree;
  return Eigen::Translation3d(object.translate) * Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) *
         Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) * Eigen::Scaling(object.scale);
}

// Its bounding box holds no pixel of the image.
bool misses_image(const ScreenTriangle& triangle, const Image& image) {
  const auto& [a, b, c] = triangle.vertices;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  return right <= 0 || bottom <= 0 || left >= image.width * kSubpixels ||
         top >= image.height * kSubpixels;
}

class GeometryBuilder {
 public:
  explicit GeometryBuilder(const Scene& scene) : scene_(scene), projection_(scene) {
    view_ = {projection_.near(), static_cast<double>(scene.image.width),
             static_cast<double>(scene.image.height), 0};
    guard_ = view_;
    guard_.margin = kGuardBand;
    for (const Material& material : scene.materials) {
      scene_materials_[material.name] = &material;
    }
  }

  Geometry build() {
    for (const Object& object : scene_.objects) {
      if (object.screen_triangles) {
        append_screen_triangles(object);
      } else {
        append_mesh(object, mesh_of(object));
      }
    }
    return std::move(geometry_);
  }

 private:
  const Mesh& mesh_of(const Object& object) {
    if (!object.mesh) {
      const Primitive& primitive = *find_primitive(object.primitive);
      const bool given = object.segments[0] > 0;
      primitive_ = primitive.make(given ? object.segments : primitive.default_segments);
      return primitive_;
    }
    if (noted_.insert(object.mesh.get()).second) {
      const std::vector<std::string>& notes = object.mesh->notes;
      geometry_.notes.insert(geometry_.notes.end(), notes.begin(), notes.end());
    }
    return *object.mesh;
  }

  const Material& material_of(const Object& object, const Mesh& mesh, const MeshFace& face) const {
    if (object.material) {
      return *scene_materials_.at(*object.material);
    }
    return mesh.materials.empty() ? default_material_ : mesh.materials[face.material];
  }

  // They are kept whichever way they turn.
  void append_screen_triangles(const Object& object) {
    const Material& material = material_of(object, Mesh{}, MeshFace{});
    for (const ScreenTriangle& triangle : *object.screen_triangles) {
      const Fate fate = fate_of(triangle);
      count(emit(triangle, fate == Fate::back_facing ? Fate::kept : fate, material));
    }
  }

  void append_mesh(const Object& object, const Mesh& mesh) {
    const Eigen::Affine3d transform = object_transform(object);
    const Eigen::Matrix3d rotation = transform.linear() / object.scale;
    std::vector<ClipVertex> vertices;
    vertices.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      vertices.push_back(
          projection_.to_clip(transform * mesh.positions[i], rotation * mesh.normals[i]));
    }
    for (const MeshFace& face : mesh.faces) {
      const auto& [a, b, c] = face.vertices;
      count(append_face({vertices[a], vertices[b], vertices[c]}, material_of(object, mesh, face)));
    }
  }

  Fate append_face(const ClipTriangle& corners, const Material& material) {
    if (wholly_outside(corners, view_)) {
      return Fate::outside;
    }
    if (wholly_inside(corners, guard_)) {
      return project(corners[0], corners[1], corners[2], material);
    }
    const std::vector<ClipVertex> polygon = clip(corners, guard_);
    Fate fate = Fate::outside;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Fate piece = project(polygon[0], polygon[i - 1], polygon[i], material);
      fate = fate == Fate::kept ? fate : piece;
    }
    geometry_.clipped += fate == Fate::kept ? 1 : 0;
    return fate;
  }

  Fate project(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c,
               const Material& material) {
    ScreenTriangle triangle;
    triangle.vertices = {projection_.to_screen(a), projection_.to_screen(b),
                         projection_.to_screen(c)};
    return emit(triangle, fate_of(triangle), material);
  }

  Fate fate_of(const ScreenTriangle& triangle) const {
    const std::int64_t area = signed_area(triangle);
    return area == 0                              ? Fate::degenerate
           : misses_image(triangle, scene_.image) ? Fate::outside
           : area > 0                             ? Fate::back_facing
                                                  : Fate::kept;
  }

  Fate emit(const ScreenTriangle& triangle, Fate fate, const Material& material) {
    if (fate == Fate::kept) {
      geometry_.triangles.push_back(triangle);
      geometry_.triangles.back().material = index_of(material);
    }
    return fate;
  }

  std::uint32_t index_of(const Material& material) {
    const auto [entry, is_new] = material_indices_.try_emplace(
        &material, static_cast<std::uint32_t>(geometry_.materials.size()));
    if (is_new) {
      geometry_.materials.push_back(material);
    }
    return entry->second;
  }

  void count(Fate fate) {
    ++geometry_.triangles_read;
    geometry_.culled_back_facing += fate == Fate::back_facing ? 1 : 0;
    geometry_.culled_outside += fate == Fate::outside ? 1 : 0;
    geometry_.degenerate += fate == Fate::degenerate ? 1 : 0;
  }

  const Scene& scene_;
  const ScreenProjection projection_;
  ViewVolume view_;   // what the image shows
  ViewVolume guard_;  // what vertex coordinates may reach
  std::map<std::string, const Material*> scene_materials_;
  std::set<const Mesh*> noted_;  // meshes whose notes have been taken over
  Mesh primitive_;
  const Material default_material_;
  std::map<const Material*, std::uint32_t> material_indices_;
  Geometry geometry_;
};

}  // namespace

std::int32_t snap(double pixels) {
  constexpr int kGrid = 1 << kGridBits;
  return static_cast<std::int32_t>(std::floor(pixels * kGrid + 0.5)) * (kSubpixels / kGrid);
}

std::int64_t signed_area(const ScreenTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  const auto cross = [](std::int64_t ux, std::int64_t uy, std::int64_t vx, std::int64_t vy) {
    return ux * vy - uy * vx;
  };
  return cross(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
}

Geometry make_geometry(const Scene& scene) {
  return GeometryBuilder(scene).build();
}

Vec3 infinite_eye(const Scene& scene) {
  if (is_screen_space(scene)) return {0, 0, -1};
  return (scene.camera.eye - scene.camera.target).normalized();
}

Vec3 light_vector(const Light& light, const ScreenVertex& vertex) {
  return light.type == LightType::directional ? Vec3(-light.direction)
                                              : Vec3(light.position - vertex.position);
}

double view_distance(const Scene& scene, const ScreenVertex& vertex) {
  if (is_screen_space(scene)) return vertex.z;
  return (scene.camera.eye - vertex.position).dot(infinite_eye(scene));
}

}  // namespace phongpipe
