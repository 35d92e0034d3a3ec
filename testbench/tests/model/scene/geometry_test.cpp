#include "model/scene/geometry.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/files/scene_file.h"
#include "model/scene/clip.h"
#include "model/scene/projection.h"
#include "testbench/tests/model/scene/scene_files.h"

namespace phongpipe {
namespace {

Scene plane_facing_the_eye() {
  Scene scene = sphere_scene();
  scene.objects[0].primitive = "plane";
  scene.objects[0].rotate_degrees = Vec3(90, 0, 0);  // from +y to +z
  return scene;
}

std::size_t culled(const Geometry& geometry) {
  return geometry.culled_back_facing + geometry.culled_outside + geometry.degenerate;
}

bool inside_guard_band(const ScreenVertex& v, const Image& image) {
  return v.x >= -kGuardBand * kSubpixels && v.x <= (image.width + kGuardBand) * kSubpixels &&
         v.y >= -kGuardBand * kSubpixels && v.y <= (image.height + kGuardBand) * kSubpixels;
}

TEST(Snap, RoundsToNearestAndHalvesUpwards) {
  constexpr int kGrid = kSubpixels / 256;
  EXPECT_EQ(snap(0), 0);
  EXPECT_EQ(snap(1), 256 * kGrid);
  EXPECT_EQ(snap(0.5 / 256), kGrid);
  EXPECT_EQ(snap(-0.5 / 256), 0);
  EXPECT_EQ(snap(-0.51 / 256), -kGrid);
  EXPECT_EQ(snap(-1.5), -384 * kGrid);
}

RC_GTEST_PROP(Snap, CommutesWithWholePixels, ()) {
  const double x = *rc::gen::inRange(-4000000, 4000000) / 1024.0;
  const int pixels = *rc::gen::inRange(-4096, 4096);
  RC_ASSERT(snap(x + pixels) == snap(x) + pixels * kSubpixels);
}

TEST(Geometry, OrthographicPlaneLandsOnItsPixels) {
  Scene scene = plane_facing_the_eye();
  scene.image.width = 96;
  scene.camera.projection = Projection::orthographic;
  scene.camera.vertical_extent = 4;  // 16 pixels a unit
  scene.objects[0].translate = Vec3(1, 0.5, 2);
  const Geometry geometry = make_geometry(scene);
  ASSERT_EQ(geometry.triangles.size(), 2U);
  std::int32_t left = 1 << 30, right = 0, top = 1 << 30, bottom = 0;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      left = std::min(left, vertex.x);
      right = std::max(right, vertex.x);
      top = std::min(top, vertex.y);
      bottom = std::max(bottom, vertex.y);
      EXPECT_NEAR(vertex.z, 3, 1e-12) << "the distance from the eye at z = 5";
      EXPECT_LT((vertex.normal - Vec3(0, 0, 1)).norm(), 1e-12);
      EXPECT_EQ(vertex.eye, Vec3(0, 0, 1));
    }
  }
  EXPECT_EQ(left, 48 * kSubpixels);
  EXPECT_EQ(right, 80 * kSubpixels);
  EXPECT_EQ(top, 8 * kSubpixels) << "up in the world is up on the screen";
  EXPECT_EQ(bottom, 40 * kSubpixels);
}

TEST(Geometry, PerspectiveDividesByDistance) {
  Scene scene = plane_facing_the_eye();
  scene.camera.vertical_fov_degrees = 90;  // 32 pixels a unit at distance 1
  const Geometry geometry = make_geometry(scene);
  ASSERT_EQ(geometry.triangles.size(), 2U);
  for (const ScreenTriangle& triangle : geometry.triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      EXPECT_EQ(vertex.x, snap(32 + 32 * vertex.position.x() / 5));
      EXPECT_EQ(vertex.y, snap(32 - 32 * vertex.position.y() / 5));
      EXPECT_NEAR(vertex.z, 1 - kNearFraction, 1e-12);
    }
  }
}

TEST(Geometry, LocalViewerHasTheTrueDistance) {
  Scene scene = plane_facing_the_eye();
  scene.shading.viewer = Viewer::local;
  for (const ScreenTriangle& triangle : make_geometry(scene).triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      EXPECT_EQ(vertex.eye, scene.camera.eye - vertex.position);
    }
  }
}

TEST(Geometry, LightVectors) {
  ScreenVertex vertex;
  vertex.position = Vec3(1, 2, 3);
  Light light;
  light.direction = Vec3(0, -1, 0);
  light.position = Vec3(1, 2, 7);
  EXPECT_EQ(light_vector(light, vertex), Vec3(0, 1, 0));
  light.type = LightType::spot;
  EXPECT_EQ(light_vector(light, vertex), Vec3(0, 0, 4));
}

// Along the view, not along the line of sight, and the same for both kinds of camera.
TEST(Geometry, ViewDistanceIsAlongTheView) {
  Scene scene = sphere_scene();
  scene.camera.eye = Vec3(1, 2, 3);
  scene.camera.target = Vec3(1, 2, -7);
  ScreenVertex vertex;
  vertex.position = Vec3(5, -9, -1);
  vertex.z = 0.25;
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    scene.camera.projection = projection;
    EXPECT_DOUBLE_EQ(view_distance(scene, vertex), 4);
  }
  scene.camera.target = Vec3(4, -2, 3);  // along (0.6, -0.8, 0)
  EXPECT_DOUBLE_EQ(view_distance(scene, vertex), 4 * 0.6 + 11 * 0.8);
  scene.objects[0].screen_triangles = std::make_shared<const std::vector<ScreenTriangle>>();
  EXPECT_EQ(view_distance(scene, vertex), 0.25) << "screen space has no world but its z";
}

TEST(Geometry, ViewDistanceOfAnOrthographicCameraIsItsDepth) {
  Scene scene = sphere_scene();
  scene.camera.projection = Projection::orthographic;
  scene.camera.eye = Vec3(2, 3, 4);
  const Geometry geometry = make_geometry(scene);
  ASSERT_FALSE(geometry.triangles.empty());
  for (const ScreenTriangle& triangle : geometry.triangles) {
    // Sums of the same few products of about 5, in another order.
    for (const ScreenVertex& v : triangle.vertices)
      EXPECT_NEAR(view_distance(scene, v), v.z, 1e-14);
  }
}

TEST(Geometry, BackFacesAreCulled) {
  Scene scene = plane_facing_the_eye();
  scene.objects[0].rotate_degrees = Vec3(-90, 0, 0);
  const Geometry geometry = make_geometry(scene);
  EXPECT_TRUE(geometry.triangles.empty());
  EXPECT_EQ(geometry.culled_back_facing, 2U);
}

TEST(Geometry, EdgeOnPlaneIsDegenerate) {
  Scene scene = plane_facing_the_eye();
  scene.objects[0].rotate_degrees = Vec3::Zero();
  scene.objects[0].scale = 0.25;
  const Geometry geometry = make_geometry(scene);
  EXPECT_EQ(geometry.degenerate, 2U);
  EXPECT_TRUE(geometry.triangles.empty());
}

TEST(Geometry, WhatIsBehindTheEyeOrBesideTheImageIsOutside) {
  for (const Vec3& where : {Vec3(0, 0, 6), Vec3(20, 0, 0), Vec3(0, -20, 0)}) {
    Scene scene = plane_facing_the_eye();
    scene.objects[0].translate = where;
    const Geometry geometry = make_geometry(scene);
    EXPECT_EQ(geometry.culled_outside, 2U) << where.transpose();
    EXPECT_TRUE(geometry.triangles.empty());
  }
}

// A floor that runs from far ahead to behind the eye.
Scene floor_under_the_eye() {
  Scene scene = sphere_scene();
  scene.objects[0].primitive = "plane";
  scene.objects[0].scale = 50;
  scene.objects[0].translate = Vec3(0, -1, 0);
  scene.shading.viewer = Viewer::local;
  return scene;
}

TEST(Geometry, NearPlaneAndGuardBandCutTheFloor) {
  const Scene scene = floor_under_the_eye();
  const Geometry geometry = make_geometry(scene);
  const double near = ScreenProjection(scene).near();
  EXPECT_EQ(near, 5.0 / 1024);
  EXPECT_EQ(geometry.triangles_read, 2U);
  EXPECT_EQ(geometry.clipped, 2U);
  ASSERT_GT(geometry.triangles.size(), 2U);
  for (const ScreenTriangle& triangle : geometry.triangles) {
    EXPECT_LT(signed_area(triangle), 0);
    for (const ScreenVertex& vertex : triangle.vertices) {
      EXPECT_TRUE(inside_guard_band(vertex, scene.image)) << vertex.x << ' ' << vertex.y;
      EXPECT_GE(5 - vertex.position.z(), near * (1 - 1e-9)) << "in front of the near plane";
      EXPECT_NEAR(vertex.position.y(), -1, 1e-12) << "still on the floor";
      EXPECT_EQ(vertex.eye, scene.camera.eye - vertex.position);
      EXPECT_GE(vertex.z, -1e-9);
      EXPECT_LT(vertex.z, 1);
    }
  }
}

TEST(Geometry, MaterialsInOrderOfFirstUse) {
  Scene scene = plane_facing_the_eye();
  for (const char* name : {"unused", "a", "b"}) {
    scene.materials.emplace_back();
    scene.materials.back().name = name;
  }
  scene.objects.assign(4, scene.objects[0]);
  scene.objects[0].material = "b";
  scene.objects[2].material = "a";
  scene.objects[3].material = "b";
  const Geometry geometry = make_geometry(scene);
  ASSERT_EQ(geometry.materials.size(), 3U);
  EXPECT_EQ(geometry.materials[0].name, "b");
  EXPECT_EQ(geometry.materials[1].name, "default");
  EXPECT_EQ(geometry.materials[2].name, "a");
  EXPECT_EQ(geometry.triangles.back().material, 0U);
}

TEST(Geometry, RotatesAboutXThenYThenZ) {
  Scene scene = plane_facing_the_eye();
  scene.camera.eye = Vec3(5, 0, 0);
  scene.objects[0].rotate_degrees = Vec3(90, 90, 0);  // +y to +z by x, then to +x by y
  const Geometry geometry = make_geometry(scene);
  ASSERT_EQ(geometry.triangles.size(), 2U);
  EXPECT_LT((geometry.triangles[0].vertices[0].normal - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(Geometry, ScaledNormalsStayUnit) {
  Scene scene = sphere_scene();
  scene.objects[0].scale = 0.3;
  for (const ScreenTriangle& triangle : make_geometry(scene).triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      ASSERT_NEAR(vertex.normal.norm(), 1, 1e-12);
      ASSERT_NEAR(vertex.position.norm(), 0.3, 1e-12);
    }
  }
}

// Wherever the camera stands and looks, inside the object too.
RC_GTEST_PROP(Geometry, EveryTriangleIsKeptOrCounted, ()) {
  const auto coordinate = [] { return *rc::gen::inRange(-400, 400) / 100.0; };
  Scene scene = sphere_scene();
  scene.objects[0].primitive =
      *rc::gen::elementOf(std::vector<std::string>{"torus", "plane", "teapot"});
  scene.objects[0].segments = {5, 4};
  scene.camera.projection = *rc::gen::element(Projection::perspective, Projection::orthographic);
  scene.camera.eye = Vec3(coordinate(), coordinate(), coordinate());
  scene.camera.target = scene.camera.eye + Vec3(1, coordinate() / 4, coordinate());
  scene.camera.vertical_fov_degrees = *rc::gen::inRange(1, 179);
  const Geometry geometry = make_geometry(scene);
  RC_ASSERT(geometry.triangles_read >= culled(geometry) + geometry.clipped);
  const std::size_t kept = geometry.triangles_read - culled(geometry);
  RC_ASSERT(geometry.triangles.size() >= kept);
  RC_ASSERT(geometry.triangles.size() <= kept + 5 * geometry.clipped);
  for (const ScreenTriangle& triangle : geometry.triangles) {
    RC_ASSERT(signed_area(triangle) < 0);
    for (const ScreenVertex& vertex : triangle.vertices) {
      RC_ASSERT(inside_guard_band(vertex, scene.image));
      RC_ASSERT(std::isfinite(vertex.z) && vertex.normal.allFinite());
    }
  }
}

// Clipping so far out rounds by more than a pixel.
TEST(Geometry, VerticesStayInTheGuardBandAtTheEndsOfTheScales) {
  Scene scene = sphere_scene();
  scene.image.width = scene.image.height = 4096;
  scene.camera.projection = Projection::orthographic;
  scene.camera.vertical_extent = 1e-9;
  scene.objects[0].primitive = "plane";
  scene.objects[0].scale = 1e9;
  scene.objects[0].rotate_degrees = Vec3(227, 141, 89);
  const Geometry geometry = make_geometry(scene);
  ASSERT_FALSE(geometry.triangles.empty());
  for (const ScreenTriangle& triangle : geometry.triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      EXPECT_TRUE(inside_guard_band(vertex, scene.image)) << vertex.x << ", " << vertex.y;
    }
  }
}

// Two triangles with a common edge, listed in opposite directions, are cut at the same points.
RC_GTEST_PROP(Clip, SharedEdgesAreCutAlike, ()) {
  const auto vertex = [] {
    ClipVertex v;
    v.x = *rc::gen::inRange(-3000, 3000) / 7.0;
    v.y = *rc::gen::inRange(-3000, 3000) / 7.0;
    v.w = v.depth = *rc::gen::inRange(-300, 300) / 7.0;
    return v;
  };
  const ClipVertex a = vertex();
  const ClipVertex b = vertex();
  const ViewVolume volume{0.5, 64, 64, 16};
  const auto on_edge = [&](const std::vector<ClipVertex>& polygon) {
    std::vector<std::pair<double, double>> points;
    const Vec3 start(a.x, a.y, a.w);
    const Vec3 along = Vec3(b.x, b.y, b.w) - start;
    for (const ClipVertex& v : polygon) {
      if ((Vec3(v.x, v.y, v.w) - start).cross(along).norm() <= 1e-9 * along.squaredNorm()) {
        points.emplace_back(v.x, v.y);
      }
    }
    std::sort(points.begin(), points.end());
    return points;
  };
  RC_PRE(a.x != b.x || a.y != b.y || a.w != b.w);
  ClipVertex left = vertex();
  ClipVertex right = vertex();
  left.x += 1000;  // off the edge
  right.x -= 1000;
  RC_ASSERT(on_edge(clip({a, b, left}, volume)) == on_edge(clip({b, a, right}, volume)));
}

TEST(Clip, InterpolatesLinearly) {
  ClipVertex a, b, c;
  a.depth = a.w = 2;
  a.normal = a.position = Vec3(2, 0, 0);
  b.depth = b.w = -2;
  b.normal = b.position = Vec3(0, 2, 0);
  c.depth = c.w = 2;
  c.position = Vec3(0, 0, 2);
  const auto polygon = clip({a, b, c}, ViewVolume{1, 8, 8, 100});
  ASSERT_EQ(polygon.size(), 4U);
  EXPECT_EQ(polygon[1].position, Vec3(1.5, 0.5, 0));
  EXPECT_EQ(polygon[1].normal, Vec3(1.5, 0.5, 0));
  EXPECT_EQ(polygon[1].depth, 1);
}

TEST(ShippedScenes, ShowWhatTheyPromise) {
  const std::filesystem::path folder = PHONGPIPE_SCENES;
  const Geometry pawn = make_geometry(load_scene(folder / "pawn.toml"));
  EXPECT_EQ(pawn.triangles_read, 14620U);
  EXPECT_EQ(pawn.culled_outside, 0U) << "the whole pawn is in the picture";
  EXPECT_EQ(make_geometry(load_scene(folder / "teapot.toml")).culled_outside, 0U);
  EXPECT_EQ(make_geometry(load_scene(folder / "two-planes.toml")).triangles.size(), 256U);
  EXPECT_EQ(make_geometry(load_scene(folder / "screen-triangles.toml")).triangles.size(), 6U);
  EXPECT_EQ(make_geometry(load_scene(folder / "mesh.toml")).materials.size(), 2U);
}

}  // namespace
}  // namespace phongpipe
