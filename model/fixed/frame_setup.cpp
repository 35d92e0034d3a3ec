#include "model/fixed/frame_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

void require_simulated(const Scene& scene) {
  const auto refuse = [&scene](const char* what, const char* instead) {
    throw InputError(
        scene.file, 0,
        fmt::format("{} not simulated yet; {}, or render with --method phong", what, instead));
  };
  if (scene.depth_cue) {
    throw InputError(scene.file, 0, "depth cueing is not simulated yet; leave [depth_cue] out");
  }
  if (scene.lights.size() > 1) refuse("several lights are", "keep one [[light]]");
  if (scene.lights.front().type == LightType::point) {
    refuse("point lights are", "use type = \"directional\"");
  }
  if (scene.lights.front().type == LightType::spot) {
    refuse("spot lights are", "use type = \"directional\"");
  }
  if (scene.shading.highlight == Highlight::reflection) {
    refuse("reflection highlights (R·V) are", "use highlight = \"halfway\"");
  }
}

bool is_grey(const Color& color) {
  return color[0] == color[1] && color[1] == color[2];
}

MaterialSetup set_up_material(const Scene& scene, const Material& material,
                              const DatapathConfiguration& configuration) {
  const Light& light = scene.lights.front();
  const Vec3 to_light = -light.direction;
  const Vec3 halfway = infinite_eye(scene) + to_light;

  MaterialSetup setup;
  setup.light.to_light = to_light;
  // Looking straight into the light there is no halfway vector, and no highlight.
  setup.light.halfway = halfway.norm() > 0 ? Vec3(halfway.normalized()) : Vec3(Vec3::Zero());
  setup.light.specular_scale = configuration.rom_words();
  setup.light.gate_scale = kOutputMax;
  setup.light.sharpness = std::max(0.0, material.shininess - 1);
  for (int c = 0; c < configuration.channels; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    setup.light.diffuse_scale[channel] = kOutputMax * material.diffuse[c] * light.color[c];
    const double ambient = kOutputMax * scene.shading.ambient_light[c] * material.ambient[c];
    const int fraction = configuration.diffuse_fraction_bits;
    setup.level[channel] = std::llround(std::ldexp(ambient + 0.5, fraction));
    setup.roms.emplace_back(configuration, material.specular[c] * light.color[c],
                            material.shininess);
  }
  return setup;
}

}  // namespace

bool is_grey(const Scene& scene, const Geometry& geometry) {
  return is_grey(scene.image.background) && is_grey(scene.shading.ambient_light) &&
         std::all_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return is_grey(light.color); }) &&
         std::all_of(geometry.materials.begin(), geometry.materials.end(), [](const Material& m) {
           return is_grey(m.ambient) && is_grey(m.diffuse) && is_grey(m.specular);
         });
}

DatapathConfiguration suit_scene(DatapathConfiguration configuration, const Scene& scene,
                                 const Geometry& geometry) {
  if (configuration.gate == GateSource::off) return configuration;
  const Color& light = scene.lights.front().color;
  const bool blind = std::any_of(
      geometry.materials.begin(), geometry.materials.end(), [&light](const Material& material) {
        return (material.specular * light > 0).any() && !(material.diffuse * light > 0).any();
      });
  configuration.gate = blind ? GateSource::series : GateSource::diffuse;
  return configuration;
}

FrameSetup::FrameSetup(const Scene& scene, const Geometry& geometry,
                       const DatapathConfiguration& chosen, int depth_bits_chosen)
    : configuration(chosen),
      width(scene.image.width),
      height(scene.image.height),
      depth_bits(depth_bits_chosen) {
  configuration.check();
  require_simulated(scene);
  plan.channels = configuration.channels;
  plan.local_viewer = scene.shading.viewer == Viewer::local;
  plan.gate_series = configuration.gate == GateSource::series;
  plan.fit = configuration.series_fit;
  for (const Material& material : geometry.materials) {
    materials.push_back(set_up_material(scene, material, configuration));
  }
  for (std::size_t c = 0; c < 3; ++c) {
    background[c] = static_cast<std::uint8_t>(
        std::lround(kOutputMax * scene.image.background[static_cast<Eigen::Index>(c)]));
  }

  if (geometry.triangles.empty()) return;
  double nearest = geometry.triangles.front().vertices.front().z, farthest = nearest;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      nearest = std::min(nearest, vertex.z);
      farthest = std::max(farthest, vertex.z);
    }
  }
  depth_offset = nearest;
  const double steps = static_cast<double>((std::int64_t{1} << depth_bits) - 1);
  depth_scale = farthest > nearest ? steps / (farthest - nearest) : 0;
}

}  // namespace phongpipe
