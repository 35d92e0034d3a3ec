#include "testbench/cosim/effect_set.h"

#include <fmt/format.h>

#include <algorithm>

namespace phongpipe {

EffectSet effects_of(const FrameSetup& frame) {
  const Scene& scene = *frame.scene;
  const Geometry& geometry = *frame.geometry;
  const DatapathConfiguration& datapath = frame.configuration;
  const auto any_light = [&](auto holds) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), holds);
  };
  const auto any_plan = [&](auto holds) {
    return std::any_of(frame.materials.begin(), frame.materials.end(),
                       [&](const MaterialSetup& material) { return holds(material.plan); });
  };
  const bool ambient = std::any_of(
      geometry.materials.begin(), geometry.materials.end(),
      [&](const Material& m) { return (scene.shading.ambient_light * m.ambient > 0).any(); });
  const bool specular = any_plan([](const SeriesPlan& plan) { return is_present(plan.specular); });
  EffectSet set;
  const auto add = [&set](bool used, std::string name) {
    (used ? set.used : set.left_out).push_back(std::move(name));
  };
  add(datapath.channels == 3, "colour");
  add(ambient, "ambient light");
  add(any_plan([](const SeriesPlan& plan) { return is_present(plan.diffuse); }), "diffuse light");
  const bool mirrored = scene.shading.highlight == Highlight::reflection;
  add(specular && !mirrored, "highlight N·H");
  add(specular && mirrored, "highlight R·V");
  add(datapath.has_gate_series(), "gate by a series of N·L");
  add(specular && scene.shading.viewer == Viewer::local, "local viewer");
  add(any_light([](const Light& light) { return light.type == LightType::point; }), "point lights");
  add(any_light([](const Light& light) { return light.type == LightType::spot; }), "spotlights");
  add(any_light(is_attenuated), "attenuation");
  add(frame.passes > 1, frame.passes > 1 ? fmt::format("{} lights in passes", frame.passes)
                                         : std::string("several lights"));
  add(frame.tables.size() > 1, frame.tables.size() > 1
                                   ? fmt::format("{} tables for the ROM", frame.tables.size())
                                   : std::string("several tables for the ROM"));
  add(scene.depth_cue.has_value(), "depth cueing");
  add(frame.depth_test, "depth test");
  return set;
}

}  // namespace phongpipe
