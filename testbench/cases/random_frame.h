// Random frames for tests of fixed point and of the pipeline: screen triangles of two materials
// under one light.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "model/fixed/frame_setup.h"
#include "testbench/system/random.h"

namespace phongpipe {

// The configuration with the blocks that the scene's effects require, or all blocks. The number of
// channels and a gate that is off are kept.
inline FrameConfiguration with_derived_blocks(FrameConfiguration configuration, const Scene& scene,
                                              const Geometry& geometry,
                                              Effects effects = Effects::derived) {
  configuration.channel_choice =
      configuration.channels == 1 ? ChannelChoice::one : ChannelChoice::three;
  configuration.gate_choice = configuration.gate;
  static_cast<EffectBlocks&>(configuration) =
      derive_blocks(configuration, scene, geometry, effects);
  return configuration;
}

// One light and an eye at infinity, in front of surfaces that face +z.
inline Scene lit_scene(int width, int height) {
  Scene scene;
  scene.image.width = width;
  scene.image.height = height;
  scene.objects.emplace_back();
  scene.lights.emplace_back();
  scene.lights.front().direction = Vec3(-0.3, -0.4, -1).normalized();
  return scene;
}

inline Material grey_material(double diffuse, double specular, double shininess) {
  Material material;
  material.ambient = Color::Constant(0.1);
  material.diffuse = Color::Constant(diffuse);
  material.specular = Color::Constant(specular);
  material.shininess = shininess;
  return material;
}

// `size`: largest distance of a corner from the triangle's middle in x and in y, in pixels. Normals
// are within 30° of an axis that roughly faces the eye.
inline ScreenTriangle random_triangle(Random& random, const Image& image, double size) {
  ScreenTriangle triangle;
  const double x = random.uniform(0, image.width), y = random.uniform(0, image.height);
  const Vec3 axis = random.unit_near(Vec3(0, 0, 1), 50);
  do {
    for (ScreenVertex& vertex : triangle.vertices) {
      vertex.x = snap(x + random.uniform(-size, size));
      vertex.y = snap(y + random.uniform(-size, size));
      vertex.z = random.uniform(0, 1);
      vertex.position = Vec3(0, 0, -vertex.z);  // 5 to 6 in front of the default camera
      vertex.normal = random.unit_near(axis, 30);
      vertex.eye = random.unit_near(Vec3(0, 0, 1), 20);
      vertex.eye *= random.uniform(2, 4);
    }
    // Slivers have gradients that overflow a register; other tests cover them.
  } while (std::llabs(signed_area(triangle)) <
           static_cast<long long>(0.2 * size * size * kSubpixels * kSubpixels));
  return triangle;
}

// Each triangle has one of two materials, at random.
inline Geometry random_geometry(Random& random, const Scene& scene, int triangles, double size) {
  Geometry geometry;
  geometry.materials = {grey_material(0.6, 0.3, 20), grey_material(0.4, 0.5, 60)};
  for (int i = 0; i < triangles; ++i) {
    geometry.triangles.push_back(random_triangle(random, scene.image, size));
    geometry.triangles.back().material = static_cast<std::uint32_t>(random.integer(0, 1));
  }
  geometry.triangles_read = geometry.triangles.size();
  return geometry;
}

}  // namespace phongpipe
