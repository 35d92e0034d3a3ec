#include "model/shading/methods/shading_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace phongpipe {
namespace {

std::optional<std::string> light_refusal(const Abilities& can, const Scene& scene) {
  if (scene.lights.size() > 1 && !can.several_lights) {
    return fmt::format("it has one light, the scene has {}", scene.lights.size());
  }
  if (scene.depth_cue && !can.depth_cue) return "it has no depth cueing";
  for (const Light& light : scene.lights) {
    if (std::find(can.lights.begin(), can.lights.end(), light.type) == can.lights.end()) {
      std::string known;
      for (const LightType type : can.lights) {
        known += fmt::format("{}{}", known.empty() ? "" : " and ", name(type));
      }
      return fmt::format("it has {} lights, the scene a {} light", known, name(light.type));
    }
    if (is_attenuated(light) && !can.attenuation) {
      return "it never computes the light's distance, by which the scene's light fades";
    }
  }
  return std::nullopt;
}

Vec3 face_normal(const ScreenTriangle& triangle) {
  const auto& v = triangle.vertices;
  const Vec3 sum = v[0].normal + v[1].normal + v[2].normal;
  const Vec3 face = (v[1].position - v[0].position).cross(v[2].position - v[0].position);
  if (!(face.stableNorm() > 0)) return sum.stableNormalized();
  return face.dot(sum) < 0 ? Vec3(-face.stableNormalized()) : Vec3(face.stableNormalized());
}

}  // namespace

OriginPixel centroid_pixel(const ScreenTriangle& triangle) {
  const auto& v = triangle.vertices;
  const auto pixel = [](std::int64_t sum) {
    return static_cast<int>(std::floor(static_cast<double>(sum) / (3.0 * kSubpixels)));
  };
  return {pixel(std::int64_t{v[0].x} + v[1].x + v[2].x),
          pixel(std::int64_t{v[0].y} + v[1].y + v[2].y)};
}

const ShadingMethod* find_shading_method(std::string_view name) {
  for (const ShadingMethod& method : shading_methods()) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

std::optional<std::string> refusal(const ShadingMethod& method, const Scene& scene,
                                   const std::vector<Material>& materials) {
  if (auto reason = light_refusal(method.abilities, scene)) return reason;
  // Viewer and kind of highlight make no difference to materials without one.
  if (std::none_of(materials.begin(), materials.end(), is_shiny)) return std::nullopt;
  if (scene.shading.viewer == Viewer::local && !method.abilities.local_viewer) {
    return "it has the eye at infinity, the scene a local viewer";
  }
  const std::optional<Highlight> highlight = method.abilities.highlight;
  if (highlight && *highlight != scene.shading.highlight) {
    return *highlight == Highlight::halfway ? "its highlight is N·H, the scene's R·V"
                                            : "its highlight is R·V, the scene's N·H";
  }
  return std::nullopt;
}

ShadingInput<double> shading_input(const ShaderContext& context) {
  const Scene& scene = context.scene;
  const Light& light = scene.lights.front();
  ShadingInput<double> in;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& vertex = context.triangle.vertices[i];
    in.x[i] = in_pixels(vertex.x) - (context.origin_x + 0.5);
    in.y[i] = in_pixels(vertex.y) - (context.origin_y + 0.5);
    in.normal[i] = vertex.normal;
    in.eye[i] = vertex.eye;
    in.to_light[i] = light_vector(light, vertex);
  }
  in.face = face_normal(context.triangle);
  in.light = in.to_light[0].stableNormalized();
  in.viewer = scene.shading.viewer == Viewer::local
                  ? Vec3((scene.camera.eye - scene.camera.target).stableNormalized())
                  : Vec3(in.eye[0].stableNormalized());
  in.halfway = Vec3(in.light + in.viewer).stableNormalized();
  in.light_dot_viewer = in.light.dot(in.viewer);
  in.axis = -light.direction;
  in.power = &context.power;
  return in;
}

}  // namespace phongpipe
