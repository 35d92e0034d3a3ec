// Reflection shading: what it makes of the normal, of lights at a distance and of a near eye.
#include <gtest/gtest.h>

#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

constexpr unsigned kReflectionTriangles = 30;

// The point of eq. 27: whatever the length of N, N' is a unit vector.
TEST(ReflectionShading, NormalsAreOfUnitLength) {
  for (unsigned seed = 0; seed < kReflectionTriangles; ++seed) {
    OneTriangle t = random_triangle(90, seed);
    double square = 0;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      t.light_from(axis);
      square += std::pow(at(t, "reflection", 100, 100).diffuse, 2);
    }
    EXPECT_NEAR(square, 1, 1e-12);
  }
}

// Where N is of unit length, H lies halfway and N' = N.
TEST(ReflectionShading, IsPhongWhereTheNormalIsOfUnitLength) {
  for (unsigned seed = 0; seed < kReflectionTriangles; ++seed) {
    OneTriangle t = random_triangle(90, seed);
    t.corner(0, 100.5, 60.5, t.triangle.vertices[0].normal);
    EXPECT_NEAR(at(t, "reflection", 100, 60).diffuse, at(t, "duff", 100, 60).diffuse, 1e-12);
  }
  OneTriangle level;
  for (ScreenVertex& v : level.triangle.vertices) v.normal = Vec3(0.4, -0.2, 0.9).normalized();
  EXPECT_LE(largest_difference(level, "reflection"), 1e-9);
  EXPECT_LE(largest_difference(level, "reflection-blinn"), 1e-9);
}

// "Very hard for the human eye to distinguish": below a step of the output up to 30° of curvature.
TEST(ReflectionShading, StaysWithinOneLsbOfPhongBelow30Degrees) {
  for (const char* name :
       {"reflection", "reflection-blinn", "reflection-hybrid", "reflection-eq34"}) {
    for (unsigned seed = 0; seed < kReflectionTriangles; ++seed) {
      OneTriangle t = random_triangle(30, seed);
      t.scene.shading.highlight = *find_shading_method(name)->abilities.highlight;
      EXPECT_LE(largest_difference(t, name), 1) << name << ", seed " << seed;
    }
  }
}

OneTriangle with_light(LightType type, double distance, double spread, unsigned seed) {
  OneTriangle t = random_triangle(spread, seed);
  Light& light = t.scene.lights[0];
  light.type = type;
  light.position = -distance * light.direction;
  light.spot_exponent = type == LightType::spot ? 8 : 0;
  light.spot_cutoff_degrees = type == LightType::spot ? 60 : 90;
  t.scene.shading.highlight = Highlight::reflection;
  return t;
}

TEST(ReflectedVectors, FollowALightAtADistance) {
  for (unsigned seed = 0; seed < kReflectionTriangles; ++seed) {
    for (const auto& [type, name] : {std::pair{LightType::point, "point-reflection"},
                                     std::pair{LightType::spot, "spot-reflection"}}) {
      EXPECT_LE(largest_difference(with_light(type, 2000, 20, seed), name), 1)
          << name << ", seed " << seed;
      OneTriangle diffuse = with_light(type, 500, 10, seed);
      diffuse.material.specular = Color::Zero();
      EXPECT_LE(largest_difference(diffuse, name), 1) << name << ", seed " << seed;
    }
  }
}

TEST(ReflectedVectors, FollowANearEye) {
  for (unsigned seed = 0; seed < kReflectionTriangles; ++seed) {
    OneTriangle t = random_triangle(20, seed);
    t.scene.shading.highlight = Highlight::reflection;
    t.eye_at(Vec3(300, -200, 1500));
    EXPECT_LE(largest_difference(t, "viewpoint-reflection"), 1) << "seed " << seed;
  }
}

// One ulp more: a light whose vector does not change needs no approximation of its own.
TEST(ReflectedVectors, WithEverythingAtInfinityAreReflectionShading) {
  for (unsigned seed = 0; seed < kReflectionTriangles; ++seed) {
    OneTriangle t = random_triangle(40, seed);
    t.scene.shading.highlight = Highlight::reflection;
    EXPECT_LE(largest_difference(t, "point-reflection", "reflection-eq34"), 1e-9);
    EXPECT_LE(largest_difference(t, "viewpoint-reflection", "reflection-eq34"), 1e-9);
  }
}

TEST(ReflectedVectors, SpotsAreDarkBeyondTheirCutoff) {
  OneTriangle t = with_light(LightType::spot, 200, 5, 1);
  t.scene.lights[0].position = Vec3(0, 0, 200);
  t.scene.lights[0].direction = Vec3(0, 0, -1);
  t.scene.lights[0].spot_cutoff_degrees = 5;  // 17.5 pixels about (100, 100)
  Color inside, outside;
  t.shader("spot-reflection")->shade(100, 100, 1, &inside);
  t.shader("spot-reflection")->shade(128, 115, 1, &outside);
  EXPECT_GT(inside[0], 100);
  EXPECT_EQ(outside[0], 0);
}

// n + N ≈ 0 and S + L ≈ 0: the span goes to exact Phong shading, and is counted.
TEST(ReflectionShading, TakesTheExactPathWhereItDegenerates) {
  OneTriangle t;
  t.light_from(Vec3(0.3, 0, 1));
  t.corner(0, 100, 60, Vec3(0, 0, 1));
  t.corner(1, 60, 130, Vec3(0.1, 0, 1));
  t.corner(2, 140, 120, Vec3(0.1, 0.1, -1));
  const auto shader = t.shader("reflection");
  Color color;
  shader->shade(100, 75, 1, &color);
  EXPECT_EQ(shader->exact_spans(), 0);
  shader->shade(138, 120, 1, &color);
  EXPECT_EQ(shader->exact_spans(), 1);
  Color phong;
  t.shader("phong")->shade(138, 120, 1, &phong);
  EXPECT_TRUE((color == phong).all());

  OneTriangle behind = with_light(LightType::spot, 50, 5, 1);
  behind.scene.lights[0].position = Vec3(0, 0, 20);
  behind.scene.lights[0].direction = Vec3(0, 0, 1);  // away from the triangle
  const auto spot = behind.shader("spot-reflection");
  spot->shade(95, 100, 10, std::vector<Color>(10).data());
  EXPECT_EQ(spot->exact_spans(), 1);
  EXPECT_LE(largest_difference(behind, "spot-reflection"), 1e-9);
}

}  // namespace
}  // namespace phongpipe
