// A scene: image, camera, lights, objects and materials.
//
// Vectors are in world units, right-handed, y up; colours are linear, 0 to 1. A scene of
// screen-space triangles is in screen axes instead: x right, y down, z away from the eye.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phongpipe {

using Vec3 = Eigen::Vector3d;
using Color = Eigen::Array3d;  // linear red, green, blue; 1 is 255 LSB of the output

constexpr int kMaxImageSize = 4096;  // pixels on a side, the range of a 12-bit coordinate

struct Image {
  int width = 512;
  int height = 512;
  Color background = Color::Zero();
};

enum class Projection { perspective, orthographic };
struct Camera {
  Projection projection = Projection::perspective;
  Vec3 eye = Vec3(0, 0, 5);
  Vec3 target = Vec3::Zero();
  Vec3 up = Vec3(0, 1, 0);
  double vertical_fov_degrees = 40;  // perspective
  double vertical_extent = 2;        // orthographic: world units from the top to the bottom edge
};

enum class Viewer { infinite, local };         // eye at infinity, or at Camera::eye
enum class Highlight { halfway, reflection };  // N·H or R·V
struct Shading {
  Viewer viewer = Viewer::infinite;
  Highlight highlight = Highlight::halfway;
  Color ambient_light = Color::Ones();
};

enum class LightType { directional, point, spot };
std::string_view name(LightType type);
struct Light {
  LightType type = LightType::directional;
  Vec3 direction = Vec3(0, 0, -1);  // in which the light travels, unit; directional and spot
  Vec3 position = Vec3::Zero();     // point and spot
  Color color = Color::Ones();
  std::array<double, 3> attenuation = {1, 0, 0};  // c, l, q of 1/(c + l d + q d²); point and spot
  double spot_exponent = 0;
  double spot_cutoff_degrees = 90;
};

// Whether the light fades with distance, and whether it fades within its cone.
bool is_attenuated(const Light& light);
bool has_spot_factor(const Light& light);

// 1/(c + l d + q d²); 1 for a directional light.
double distance_attenuation(const Light& light, double distance);

struct Material {
  std::string name = "default";
  Color ambient = Color::Constant(0.1);
  Color diffuse = Color::Constant(0.7);
  Color specular = Color::Constant(0.3);
  double shininess = 20;  // n of (N·H)^n
};

// Whether it reflects a highlight.
bool is_shiny(const Material& material);

struct Mesh;            // mesh.h
struct ScreenTriangle;  // geometry.h

// A mesh or screen-space triangles; a primitive if both are null.
struct Object {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const std::vector<ScreenTriangle>> screen_triangles;
  std::string primitive;                 // name of the primitive
  std::array<int, 2> segments = {0, 0};  // [around, along]; 0 is the primitive's own default
  Vec3 translate = Vec3::Zero();         // applied last
  Vec3 rotate_degrees = Vec3::Zero();    // about x, then y, then z
  double scale = 1;                      // applied first
  std::optional<std::string> material;   // none: the mesh's own, else the default material
};

struct DepthCue {
  double near = 0;
  double far = 0;
  Color color = Color::Zero();
};

struct Scene {
  std::string source;  // name of the scene in messages, such as its file
  Image image;
  Camera camera;
  Shading shading;
  std::vector<Light> lights;        // at least one
  std::vector<Object> objects;      // at least one
  std::vector<Material> materials;  // those of the scene file, by name
  std::optional<DepthCue> depth_cue;
};

// Whether the objects are triangles in screen space. Such a scene has no camera.
bool is_screen_space(const Scene& scene);

}  // namespace phongpipe
