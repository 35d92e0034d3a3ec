// Exact Phong shading, the reference all accounts are measured against: values computed by hand.
#include "model/shading/phong.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace phongpipe {
namespace {

constexpr double kExact = 1e-14;
constexpr double kHalfRoot = 0.70710678118654752;  // cos 45°

// One directional light from the eye; ambient 0.1, diffuse 0.5, specular 0.25, n = 4.
struct Bench {
  Scene scene;
  Material material;

  Bench() {
    scene.lights.emplace_back();
    material.ambient = Color(0.1, 0.2, 0.3);
    material.diffuse = Color::Constant(0.5);
    material.specular = Color::Constant(0.25);
    material.shininess = 4;
  }
  Light& light() { return scene.lights.front(); }
  Color color(const Vec3& normal, const Vec3& eye, const Vec3& to_light) const {
    return reflect(scene, material, normal,
                   {illuminate(scene, scene.lights.front(), eye, to_light)});
  }
};

const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

void expect_color(const Color& color, double red, double green, double blue) {
  EXPECT_NEAR(color[0], red, kExact);
  EXPECT_NEAR(color[1], green, kExact);
  EXPECT_NEAR(color[2], blue, kExact);
}

TEST(Reflect, WithoutLightsAmbientRemains) {
  Bench bench;
  bench.scene.shading.ambient_light = Color(0.5, 1, 2);
  expect_color(reflect(bench.scene, bench.material, kZ, {}), 0.05, 0.2, 0.6);
}

TEST(Reflect, FacingLightAndEyeEverythingCounts) {
  expect_color(Bench().color(kZ, kZ, kZ), 0.85, 0.95, 1.05);  // not clamped here
}

TEST(Reflect, TheLengthOfTheNormalDoesNotCount) {
  expect_color(Bench().color(1e-3 * kZ, kZ, kZ), 0.85, 0.95, 1.05);
}

TEST(Reflect, LightFromBehindOrAlongTheSurfaceIsDark) {
  Bench bench;
  expect_color(bench.color(kZ, kZ, -kZ), 0.1, 0.2, 0.3);
  expect_color(bench.color(kZ, kZ, kX), 0.1, 0.2, 0.3);
  // N·H > 0 although N·L < 0: no highlight on an unlit face.
  const Vec3 below = Vec3(0.8, 0, -0.6);
  ASSERT_GT((kZ + below).dot(kZ), 0);
  expect_color(bench.color(kZ, kZ, below), 0.1, 0.2, 0.3);
}

TEST(Reflect, HalfwayAgainstReflection) {
  Bench bench;
  // Light and eye 45° to either side of the normal: H = N, and V is the mirrored L.
  const Vec3 left(-kHalfRoot, 0, kHalfRoot), right(kHalfRoot, 0, kHalfRoot);
  const double both = 0.1 + 0.5 * kHalfRoot + 0.25;
  EXPECT_NEAR(bench.color(kZ, left, right)[0], both, kExact);
  // Eye along the normal: N·H = cos 22.5°, R·V = cos 45°; cos²22.5° = (1 + cos 45°)/2.
  const double squared = (1 + kHalfRoot) / 2;
  EXPECT_NEAR(bench.color(kZ, kZ, right)[0], 0.1 + 0.5 * kHalfRoot + 0.25 * squared * squared,
              kExact);
  bench.scene.shading.highlight = Highlight::reflection;
  EXPECT_NEAR(bench.color(kZ, left, right)[0], both, kExact);
  EXPECT_NEAR(bench.color(kZ, kZ, right)[0], 0.1 + 0.5 * kHalfRoot + 0.25 * 0.25, kExact);
  // The eye beyond 90° of R: an even power must not light it.
  EXPECT_NEAR(bench.color(kZ, Vec3(0.8, 0, 0.6), Vec3(0.8, 0, 0.6))[0], 0.1 + 0.5 * 0.6, kExact);
}

TEST(Reflect, SeveralLightsAddUp) {
  Bench bench;
  bench.material.specular = Color::Zero();
  bench.light().color = Color(1, 0.5, 0);
  const Illumination front = illuminate(bench.scene, bench.light(), kZ, kZ);
  expect_color(reflect(bench.scene, bench.material, kZ, {front, front}), 1.1, 0.7, 0.3);
}

TEST(Illuminate, APointLightFadesWithDistance) {
  Bench bench;
  bench.light().type = LightType::point;
  bench.light().attenuation = {1, 0.5, 0.25};
  bench.light().color = Color(1, 0.5, 0.25);
  const Illumination light = illuminate(bench.scene, bench.light(), kZ, 4 * kZ);
  EXPECT_NEAR(light.light.norm(), 1, kExact);
  expect_color(light.color, 1 / 7.0, 0.5 / 7, 0.25 / 7);  // 1 + 0.5·4 + 0.25·16
}

TEST(Illuminate, ASpotHasACutoffAndAnExponent) {
  Bench bench;
  bench.light().type = LightType::spot;
  bench.light().direction = -kZ;
  bench.light().attenuation = {0, 0, 1};
  bench.light().spot_exponent = 2;
  bench.light().spot_cutoff_degrees = 60;
  const auto at = [&](const Vec3& to_light) {
    return illuminate(bench.scene, bench.light(), kZ, to_light).color[0];
  };
  EXPECT_NEAR(at(2 * kZ), 0.25, kExact);                        // on the axis, 2 away
  EXPECT_NEAR(at(Vec3(kHalfRoot, 0, kHalfRoot)), 0.5, kExact);  // cos² 45°
  const auto tilted = [](double degrees) {
    const double angle = degrees * 3.14159265358979323846 / 180;
    return Vec3(std::sin(angle), 0, std::cos(angle));
  };
  EXPECT_GT(at(tilted(59.9)), 0.25);
  EXPECT_EQ(at(tilted(60.1)), 0);
  bench.light().spot_cutoff_degrees = 90;
  EXPECT_NEAR(at(tilted(75)), std::pow(std::cos(75 * 3.14159265358979323846 / 180), 2), kExact);
  EXPECT_EQ(at(tilted(120)), 0) << "an even exponent must not light backwards";
}

TEST(Illuminate, LookingIntoTheLightGivesNoHighlightAndNoNaN) {
  Bench bench;
  const Illumination light = illuminate(bench.scene, bench.light(), -kZ, kZ);
  EXPECT_EQ(light.highlight.norm(), 0);
  expect_color(bench.color(kZ, -kZ, kZ), 0.6, 0.7, 0.8);
  const Illumination at_the_surface = illuminate(bench.scene, bench.light(), kZ, Vec3::Zero());
  EXPECT_EQ(at_the_surface.light.norm(), 0);
  EXPECT_TRUE(at_the_surface.color.allFinite());
}

// Corners at (0,0), (16,0), (0,16) pixels.
ScreenTriangle triangle_with(const std::array<Vec3, 3>& normals, const std::array<Vec3, 3>& eyes) {
  ScreenTriangle triangle;
  const std::array<std::array<int, 2>, 3> corners = {{{0, 0}, {16, 0}, {0, 16}}};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.vertices[i].x = corners[i][0] * kSubpixels;
    triangle.vertices[i].y = corners[i][1] * kSubpixels;
    triangle.vertices[i].normal = normals[i];
    triangle.vertices[i].eye = eyes[i];
    triangle.vertices[i].position = Vec3(corners[i][0] / 16.0, corners[i][1] / 16.0, 0);
  }
  return triangle;
}

// What is interpolated between the corners at the centre of pixel (x, y).
Vec3 at_pixel(const std::array<Vec3, 3>& corner, int x, int y) {
  const double u = (x + 0.5) / 16, v = (y + 0.5) / 16;
  return (1 - u - v) * corner[0] + u * corner[1] + v * corner[2];
}

const std::array<Vec3, 3> kNormals = {Vec3(-0.6, 0, 0.8), Vec3(0.6, 0, 0.8), Vec3(0, 0.96, 0.28)};

TEST(PhongTriangle, InterpolatesThenNormalises) {
  Bench bench;
  const PhongTriangle triangle(bench.scene, bench.material, triangle_with(kNormals, {kZ, kZ, kZ}));
  std::array<Color, 5> colors;
  triangle.shade(3, 7, 5, colors.data());
  for (int i = 0; i < 5; ++i) {
    const double cosine = at_pixel(kNormals, 3 + i, 7).normalized().z();
    const double expected = 255 * (0.1 + 0.5 * cosine + 0.25 * std::pow(cosine, 4));
    EXPECT_NEAR(colors[static_cast<std::size_t>(i)][0], expected, 255 * kExact) << "pixel " << i;
  }
}

TEST(PhongTriangle, InterpolatesEyeAndLightWhereTheyVary) {
  Bench bench;
  bench.scene.shading.viewer = Viewer::local;
  bench.light().type = LightType::point;
  bench.light().position = Vec3(0.25, 0.5, 2);
  bench.light().attenuation = {1, 0.5, 0.25};
  const std::array<Vec3, 3> eyes = {Vec3(0, 0, 3), Vec3(-1, 0, 3), Vec3(0, -1, 3)};
  const ScreenTriangle source = triangle_with(kNormals, eyes);
  const PhongTriangle triangle(bench.scene, bench.material, source);
  std::array<Vec3, 3> to_light;
  for (std::size_t i = 0; i < 3; ++i) {
    to_light[i] = bench.light().position - source.vertices[i].position;
  }
  std::array<Color, 8> colors;
  triangle.shade(0, 4, 8, colors.data());
  for (int i = 0; i < 8; ++i) {
    const Vec3 light = at_pixel(to_light, i, 4), normal = at_pixel(kNormals, i, 4).normalized();
    const double d = light.norm();
    const Vec3 halfway = (at_pixel(eyes, i, 4).normalized() + light / d).normalized();
    const double falloff = 1 / (1 + 0.5 * d + 0.25 * d * d);
    const double power = std::pow(normal.dot(halfway), 4);
    const double expected = 0.1 + falloff * (0.5 * normal.dot(light / d) + 0.25 * power);
    ASSERT_GT(normal.dot(light), 0);
    EXPECT_NEAR(colors[static_cast<std::size_t>(i)][0], 255 * expected, 255 * kExact)
        << "pixel " << i;
  }
}

// A bench whose default camera, 5 before the origin, sees the corners at these distances.
struct CuedBench : Bench {
  explicit CuedBench(const Color& cue_color = Color(0.5, 0, 0.25)) {
    scene.objects.emplace_back();
    scene.depth_cue = DepthCue{4, 8, cue_color};
  }
  Color color_at(const std::array<double, 3>& distances, int x, int y) const {
    ScreenTriangle source = triangle_with({kZ, kZ, kZ}, {kZ, kZ, kZ});
    for (std::size_t i = 0; i < 3; ++i) source.vertices[i].position = (5 - distances[i]) * kZ;
    Color color;
    PhongTriangle(scene, material, source).shade(x, y, 1, &color);
    return color / 255;
  }
  Color color_at(double distance) const { return color_at({distance, distance, distance}, 3, 4); }
};

TEST(PhongTriangle, FadesToTheCuesColorWithDistance) {
  const CuedBench bench;  // facing light and eye, 0.85, 0.95, 1.05
  expect_color(bench.color_at(4), 0.85, 0.95, 1);
  expect_color(bench.color_at(2), 0.85, 0.95, 1);  // nearer than near
  expect_color(bench.color_at(8), 0.5, 0, 0.25);
  expect_color(bench.color_at(50), 0.5, 0, 0.25);  // farther than far
  expect_color(bench.color_at(5), 0.25 * 0.5 + 0.75 * 0.85, 0.75 * 0.95, 0.25 * 0.25 + 0.75 * 1.05);
}

// Each channel of 0.85, 0.95, 1.05 and what more diffuse light there is.
TEST(PhongTriangle, WhatIsOverexposedFadesFromItsUnclampedValue) {
  CuedBench bench(Color::Zero());
  bench.material.diffuse = Color::Constant(1.5);
  expect_color(bench.color_at(6), 0.925, 0.975, 1);  // half of 1.85, 1.95, 2.05
  expect_color(bench.color_at(7), 0.4625, 0.4875, 0.5125);
}

TEST(PhongTriangle, InterpolatesTheDistanceLinearlyOnTheScreen) {
  const CuedBench bench(Color::Zero());
  for (const int x : {0, 5, 9}) {
    const double distance = 4 + 3 * (x + 0.5) / 16 + 2 * 4.5 / 16;
    EXPECT_NEAR(bench.color_at({4, 7, 6}, x, 4)[0], 0.85 * (8 - distance) / 4, kExact);
  }
}

TEST(PhongTriangle, ClampsToTheOutputsRange) {
  Bench bench;
  bench.material.diffuse = Color(2, 0.5, 0);
  bench.material.ambient = Color(0, 0.6, 0);
  bench.material.specular = Color::Zero();
  const PhongTriangle triangle(bench.scene, bench.material,
                               triangle_with({kZ, kZ, kZ}, {kZ, kZ, kZ}));
  Color color;
  triangle.shade(1, 1, 1, &color);
  EXPECT_EQ(color[0], 255);
  EXPECT_EQ(color[1], 255);
  EXPECT_EQ(color[2], 0);
}

}  // namespace
}  // namespace phongpipe
