#include "testbench/cosim/scene_hash.h"

#include <cstring>
#include <string_view>

#include "model/scene/geometry.h"
#include "model/scene/mesh.h"
#include "testbench/system/fnv_hash.h"

namespace phongpipe {
namespace {

// Records are taken apart by structured bindings: a member that is added does not compile here
// until it is hashed.
class SceneHasher {
 public:
  template <typename... Values>
  void add(const Values&... values) {
    (add_one(values), ...);
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  template <typename Number>
  std::enable_if_t<std::is_integral_v<Number> || std::is_enum_v<Number>> add_one(Number number) {
    hash_.add(static_cast<std::uint64_t>(number));
  }
  void add_one(double number) {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof number);
    std::memcpy(&bits, &number, sizeof bits);
    hash_.add(bits);
  }
  void add_one(const std::string& text) {
    add(text.size());
    hash_.add(std::string_view(text));
  }
  void add_one(const Vec3& v) { add(v.x(), v.y(), v.z()); }
  void add_one(const Color& c) { add(c[0], c[1], c[2]); }
  template <typename T>
  void add_one(const std::vector<T>& items) {
    add(items.size());
    for (const T& item : items) add_one(item);
  }
  template <typename T, std::size_t kSize>
  void add_one(const std::array<T, kSize>& items) {
    for (const T& item : items) add_one(item);
  }
  template <typename T>
  void add_one(const std::optional<T>& item) {
    add(item.has_value());
    if (item) add_one(*item);
  }
  template <typename T>
  void add_one(const std::shared_ptr<const T>& item) {
    add(item != nullptr);
    if (item) add_one(*item);
  }

  void add_one(const Image& image) {
    const auto& [width, height, background] = image;
    add(width, height, background);
  }
  void add_one(const Camera& camera) {
    const auto& [projection, eye, target, up, vertical_fov_degrees, vertical_extent] = camera;
    add(projection, eye, target, up, vertical_fov_degrees, vertical_extent);
  }
  void add_one(const Shading& shading) {
    const auto& [viewer, highlight, ambient_light] = shading;
    add(viewer, highlight, ambient_light);
  }
  void add_one(const Light& light) {
    const auto& [type, direction, position, color, attenuation, spot_exponent,
                 spot_cutoff_degrees] = light;
    add(type, direction, position, color, attenuation, spot_exponent, spot_cutoff_degrees);
  }
  void add_one(const Material& material) {
    const auto& [name, ambient, diffuse, specular, shininess] = material;
    add(name, ambient, diffuse, specular, shininess);
  }
  void add_one(const MeshFace& face) {
    const auto& [vertices, material] = face;
    add(vertices, material);
  }
  void add_one(const Mesh& mesh) {
    const auto& [positions, normals, faces, materials, notes] = mesh;
    add(positions, normals, faces, materials, notes);
  }
  void add_one(const ScreenVertex& vertex) {
    const auto& [x, y, z, normal, eye, position] = vertex;
    add(x, y, z, normal, eye, position);
  }
  void add_one(const ScreenTriangle& triangle) {
    const auto& [vertices, material, piece] = triangle;
    add(vertices, material, piece);
  }
  void add_one(const Object& object) {
    const auto& [mesh, screen_triangles, primitive, segments, translate, rotate_degrees, scale,
                 material] = object;
    add(mesh, screen_triangles, primitive, segments, translate, rotate_degrees, scale, material);
  }
  void add_one(const DepthCue& cue) {
    const auto& [near, far, color] = cue;
    add(near, far, color);
  }

  FnvHash hash_;
};

}  // namespace

std::uint64_t scene_hash(const Scene& scene) {
  const auto& [source, image, camera, shading, lights, objects, materials, depth_cue] = scene;
  SceneHasher hasher;
  hasher.add(image, camera, shading, lights, objects, materials, depth_cue);
  return hasher.value();
}

}  // namespace phongpipe
