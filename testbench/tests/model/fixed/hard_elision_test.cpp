// Where leaving out what cannot be seen is delicate: the picture is that of the whole computation,
// to the bit.
#include <gtest/gtest.h>

#include <cmath>

#include "model/fixed/model_frame.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

ScreenVertex vertex(double x, double y, const Vec3& normal) {
  ScreenVertex v;
  v.x = snap(x);
  v.y = snap(y);
  v.normal = normal;
  v.eye = Vec3(0, 0, 1);
  return v;
}

void expect_same_picture(const Scene& scene, const Geometry& geometry,
                         GateSource gate = GateSource::diffuse) {
  FrameConfiguration chosen;
  chosen.series_fit = SeriesFit::weighted;
  chosen.gate = gate;
  const auto picture = [&](Effects effects) {
    const FrameConfiguration suited = with_derived_blocks(chosen, scene, geometry, effects);
    return run_model(FrameSetup(scene, geometry, suited, effects)).colors();
  };
  EXPECT_EQ(picture(Effects::derived), picture(Effects::all));
}

// Squares of length differ by less than their rounding, and yet the normals turn.
TEST(HardElision, NormalsThatAlmostDoNotTurn) {
  const Scene scene = lit_scene(256, 256);
  Geometry geometry;
  geometry.materials = {grey_material(0.7, 0, 1)};
  for (int i = 0; i < 400; ++i) {
    const double x = 12.0 * (i % 20), y = 12.0 * (i / 20), angle = 0.3 + 0.002 * i;
    const auto normal = [angle](double more) {
      return Vec3(std::sin(angle + more), 0, std::cos(angle + more));
    };
    geometry.triangles.push_back({{vertex(x, y, normal(0)), vertex(x, y + 10, normal(6e-9)),
                                   vertex(x + 10, y, normal(1.2e-8))},
                                  0});
  }
  expect_same_picture(scene, geometry);
}

// The gradients of slivers magnify what double precision loses.
TEST(HardElision, SliversOfEqualNormals) {
  const Scene scene = lit_scene(1024, 1024);
  Geometry geometry;
  geometry.materials = {grey_material(0.7, 0.3, 20)};
  for (int i = 0; i < 40; ++i) {
    const double x = 2.0 * i;
    const Vec3 normal = Vec3(0.1 + 0.01 * i, 0.2, 1).normalized();
    geometry.triangles.push_back(
        {{vertex(x + 0.5, 0.5, normal), vertex(x + 450.5, 450.5 - 1.0 / 256, normal),
          vertex(x + 900.5, 900.5, normal)},
         0});
  }
  expect_same_picture(scene, geometry);
}

// Below 0 the table is read at its first word, and of a blunt power that one is not 0.
TEST(HardElision, HighlightsWhoseFirstWordShows) {
  const Scene scene = lit_scene(128, 128);
  for (const double shininess : {0.0, 0.3, 0.8, 1.0}) {
    for (const GateSource gate : {GateSource::diffuse, GateSource::off}) {
      Geometry geometry;
      geometry.materials = {grey_material(0.3, 0.5, shininess)};
      const Vec3 light = -scene.lights[0].direction, eye = Vec3(0, 0, 1);
      // Normals that face the light from beside, and are seen from behind.
      const Vec3 away = (light - 1.2 * light.dot(eye) * eye - eye).normalized();
      geometry.triangles.push_back(
          {{vertex(10, 10, away), vertex(10, 118, (away + Vec3(0.1, 0, 0)).normalized()),
            vertex(120, 10, (away + Vec3(0, 0.1, 0)).normalized())},
           0});
      SCOPED_TRACE(shininess);
      expect_same_picture(scene, geometry, gate);
    }
  }
}

// On a vertex, a light that fades from infinity: numbers all the same.
TEST(HardElision, ALightOnAVertex) {
  Scene scene = lit_scene(128, 128);
  scene.lights[0].type = LightType::point;
  scene.lights[0].attenuation = {0, 0, 1};
  scene.lights[0].position = Vec3(0, 0, 0);
  Geometry geometry;
  geometry.materials = {grey_material(0.7, 0.3, 20)};
  ScreenTriangle triangle = {{vertex(10, 10, Vec3(0, 0, 1)), vertex(10, 118, Vec3(0, 0, 1)),
                              vertex(120, 10, Vec3(0, 0, 1))},
                             0};
  triangle.vertices[1].position = Vec3(0, -1, 0.1);
  triangle.vertices[2].position = Vec3(1, 0, 0.1);
  geometry.triangles = {triangle};
  const FrameSetup frame(scene, geometry, with_derived_blocks({}, scene, geometry));
  for (const ExponentRom& rom : frame.tables[0].roms) {
    for (const std::int32_t word : rom.words()) EXPECT_TRUE(word >= 0 && word <= kOutputMax);
  }
  expect_same_picture(scene, geometry);
}

}  // namespace
}  // namespace phongpipe
