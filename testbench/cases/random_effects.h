// Random scenes with any effects the pipeline simulates: lights, colours, materials without diffuse
// light or highlight, either viewer, depth cueing, overlapping triangles or a mesh without overlap.
#pragma once

#include <string>
#include <vector>

#include "testbench/cases/format_range.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {

struct RandomEffects {
  Scene scene;
  Geometry geometry;
  FrameConfiguration configuration;  // blocks not yet derived from the scene
};

// Channels are multiples of 1/16, from 0 to 1, so that some colours of a scene are equal now and
// then.
inline Color random_light(Random& random, bool grey) {
  const auto channel = [&random] { return random.integer(0, 16) / 16.0; };
  if (grey) return Color::Constant(channel());
  return Color{channel(), channel(), channel()};
}

// A square mesh of 2 · cells² triangles that share their corners.
inline void tile(Random& random, const Image& image, int cells, Geometry& geometry) {
  const auto count = static_cast<std::size_t>(cells) + 1;
  std::vector<ScreenVertex> corners(count * count);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ScreenVertex& v = corners[i];
    v.x = snap(image.width * static_cast<double>(i % count) / cells);
    v.y = snap(image.height * static_cast<double>(i / count) / cells);
    v.z = random.uniform(0, 1);
    v.position = Vec3(0, 0, -v.z);
    v.normal = random.unit_near(Vec3(0, 0, 1), 30);
    v.eye = random.unit_near(Vec3(0, 0, 1), 20);
    v.eye *= random.uniform(2, 4);
  }
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    geometry.triangles.emplace_back();
    geometry.triangles.back().vertices = {corners[a], corners[b], corners[c]};
  };
  for (std::size_t row = 0; row + 1 < count; ++row) {
    for (std::size_t i = row * count; i + 1 < (row + 1) * count; ++i) {
      add(i, i + count, i + 1);
      add(i + 1, i + count, i + count + 1);
    }
  }
}

inline RandomEffects random_effects(Random& random, bool grey = false) {
  RandomEffects result;
  Scene& scene = result.scene;
  scene = lit_scene(72, 48);
  scene.image.background = random_light(random, grey);
  scene.shading.ambient_light = random_light(random, grey);
  scene.shading.viewer = random.integer(0, 1) == 0 ? Viewer::infinite : Viewer::local;
  scene.lights.resize(static_cast<std::size_t>(random.integer(1, 4)));
  for (Light& light : scene.lights) {
    light.direction = -random.unit_near(Vec3(0, 0, 1), 70);
    light.color = random_light(random, grey);
  }
  if (random.integer(0, 1) == 0) {
    const double near = random.uniform(4.5, 5.5);
    scene.depth_cue = DepthCue{near, near + random.uniform(0.2, 1), random_light(random, grey)};
  }

  Geometry& geometry = result.geometry;
  geometry.materials.resize(static_cast<std::size_t>(random.integer(1, 4)));
  const bool diffuse = random.integer(0, 3) > 0, specular = random.integer(0, 3) > 0;
  for (Material& material : geometry.materials) {
    material.ambient = 0.2 * random_light(random, grey);
    material.diffuse = material.specular = Color::Zero();
    if (diffuse && random.integer(0, 3) > 0) material.diffuse = random_light(random, grey);
    if (specular && random.integer(0, 3) > 0) material.specular = random_light(random, grey);
    material.shininess = random.integer(0, 1) == 0 ? 20 : 60;
  }
  if (random.integer(0, 2) == 0) {
    tile(random, scene.image, random.integer(1, 5), geometry);
  } else {
    const int triangles = random.integer(1, 25);
    for (int i = 0; i < triangles; ++i) {
      geometry.triangles.push_back(random_triangle(random, scene.image, random.uniform(3, 20)));
    }
  }
  for (ScreenTriangle& triangle : geometry.triangles) {
    triangle.material = static_cast<std::uint32_t>(
        random.integer(0, static_cast<int>(geometry.materials.size()) - 1));
  }
  geometry.triangles_read = geometry.triangles.size();

  FrameConfiguration& c = result.configuration;
  c.channels = grey ? 1 : 3;
  c.rom_address_bits = 6;  // short loads, so that other waits are visible
  c.rom_data_bits = random.integer(kMinRomDataBits, kMaxRomDataBits);
  c.gate = random.integer(0, 3) == 0 ? GateSource::off : GateSource::diffuse;
  c.anchor = random.integer(0, 1) == 0 ? Anchor::triangle : Anchor::span;
  c.series_fit = static_cast<SeriesFit>(random.integer(0, 3));
  c.rom_layout = static_cast<RomLayout>(random.integer(0, 2));
  return result;
}

// Description of a case, for a failing test.
inline std::string text(const RandomEffects& effects) {
  const auto& [scene, geometry, c] = effects;
  return std::to_string(scene.lights.size()) + " lights, " +
         std::to_string(geometry.materials.size()) + " materials, " +
         std::to_string(geometry.triangles.size()) + " triangles, gate " +
         std::to_string(static_cast<int>(c.gate)) + ", fit " +
         std::to_string(static_cast<int>(c.series_fit)) +
         (scene.shading.viewer == Viewer::local ? ", local viewer" : "") +
         (scene.depth_cue ? ", depth cueing" : "");
}

}  // namespace phongpipe
