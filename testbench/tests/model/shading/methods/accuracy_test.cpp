// Each method against exact Phong shading, where it should agree.
#include <gtest/gtest.h>

#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

constexpr unsigned kTriangles = 30;
constexpr double kRounding = 255e-12;

// Reflections of one row of 40 pixels through the middle of the triangle.
std::vector<Reflection<double>> middle_row(const OneTriangle& t, std::string_view method) {
  std::vector<Reflection<double>> row(40);
  t.shader(method)->reflect(80, 103, 40, row.data());
  return row;
}

OneTriangle scene_for(const ShadingMethod& method, double spread, unsigned seed) {
  OneTriangle t = random_triangle(spread, seed);
  if (method.abilities.highlight) t.scene.shading.highlight = *method.abilities.highlight;
  return t;
}

TEST(ShadingMethods, DuffIsPhong) {
  for (const char* name : {"duff", "duff-blinn", "duff-eq17", "duff-eq33", "duff-eq34"}) {
    for (const double spread : {10.0, 60.0, 120.0}) {
      for (unsigned seed = 0; seed < kTriangles; ++seed) {
        OneTriangle t = scene_for(*find_shading_method(name), spread, seed);
        EXPECT_LE(largest_difference(t, name), kRounding) << name << ", seed " << seed;
        t.material.specular = Color::Zero();
        EXPECT_LE(largest_difference(t, name), kRounding) << name << ", diffuse, seed " << seed;
      }
    }
  }
}

TEST(ShadingMethods, PhongsLoopIsTheReference) {
  for (unsigned seed = 0; seed < kTriangles; ++seed) {
    const OneTriangle t = random_triangle(60, seed);
    const auto loop = middle_row(t, "phong"), duff = middle_row(t, "duff");
    for (std::size_t i = 0; i < loop.size(); ++i) {
      EXPECT_NEAR(loop[i].diffuse, duff[i].diffuse, 1e-12);
      EXPECT_NEAR(loop[i].highlight, duff[i].highlight, 1e-12);
    }
  }
}

// R·V of eye and light at a distance: the bare loop of exact Phong shading against its colours.
TEST(ShadingMethods, PhongsLoopIsTheReferenceAtADistanceToo) {
  for (const Highlight highlight : {Highlight::halfway, Highlight::reflection}) {
    for (unsigned seed = 0; seed < kTriangles; ++seed) {
      OneTriangle t = random_triangle(30, seed);
      t.material.shininess = 1;
      t.material.specular = Color(0, 0.4, 0.4);
      t.scene.shading.highlight = highlight;
      t.scene.lights[0].type = LightType::point;
      t.scene.lights[0].position = -150 * t.scene.lights[0].direction;
      t.eye_at(Vec3(50, 20, 200));
      const auto row = middle_row(t, "phong");
      std::vector<Color> colors(row.size());
      t.shader("phong")->shade(80, 103, 40, colors.data());
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (colors[i][1] >= 255 || row[i].diffuse <= 0) continue;
        EXPECT_NEAR(255 * 0.6 * row[i].diffuse, colors[i][0], 1e-9);
        EXPECT_NEAR(255 * 0.4 * std::max(0.0, row[i].highlight), colors[i][1] - colors[i][0], 1e-9);
      }
    }
  }
}

TEST(ShadingMethods, SteppingKeepsItsPrecisionOver4096Pixels) {
  OneTriangle t;
  t.corner(0, 0, 0, Vec3(-0.5, 0.1, 1));
  t.corner(1, 0, 400, Vec3(-0.5, -0.3, 1));
  t.corner(2, 4096, 200, Vec3(0.6, 0, 1));
  std::vector<Color> phong(3900), stepped(3900);
  t.shader("phong")->shade(10, 200, 3900, phong.data());
  t.shader("duff")->shade(10, 200, 3900, stepped.data());
  for (std::size_t i = 0; i < phong.size(); ++i) {
    EXPECT_LE((phong[i] - stepped[i]).abs().maxCoeff(), 1e-9) << i;
  }
}

// The middle of an interval of 1/512 of the value at most, times ½ for the root.
TEST(ShadingMethods, DuffsTableIsGoodToItsStep) {
  const double relative = 4.9e-4;
  for (unsigned seed = 0; seed < kTriangles; ++seed) {
    const OneTriangle t = random_triangle(60, seed);
    const auto exact = middle_row(t, "duff"), table = middle_row(t, "duff-table");
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_NEAR(table[i].diffuse, exact[i].diffuse, relative * std::abs(exact[i].diffuse));
      EXPECT_NEAR(table[i].highlight, exact[i].highlight, relative * std::abs(exact[i].highlight));
    }
  }
}

// τ about the pixel the series is taken about.
double tau(const OneTriangle& t) {
  const Vec3 c = interpolated_normal(input(t)).c;
  double largest = 0;
  for (const ScreenVertex& vertex : t.triangle.vertices)
    largest = std::max(largest, (vertex.normal - c).norm());
  return largest / c.norm();
}

TEST(ShadingMethods, TaylorsDiffuseErrorStaysBelowHalfTauCubed) {
  for (const double spread : {10.0, 20.0, 40.0, 60.0}) {
    for (unsigned seed = 0; seed < kTriangles; ++seed) {
      const OneTriangle t = random_triangle(spread, seed);
      const double bound = std::pow(tau(t), 3) / 2;
      const auto exact = middle_row(t, "duff"), series = middle_row(t, "taylor");
      for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_NEAR(series[i].diffuse, exact[i].diffuse, bound) << "seed " << seed;
      }
    }
  }
}

TEST(ShadingMethods, TaylorsFiniteFormWithTheEyeFarAwayIsTheInfiniteOne) {
  for (unsigned seed = 0; seed < kTriangles; ++seed) {
    OneTriangle t = random_triangle(30, seed);
    const auto infinite = middle_row(t, "taylor");
    t.eye_at(Vec3(0, 0, 1e9));
    const auto finite = middle_row(t, "taylor-local");
    for (std::size_t i = 0; i < finite.size(); ++i) {
      EXPECT_NEAR(finite[i].highlight, infinite[i].highlight, 1e-6);
    }
  }
}

TEST(ShadingMethods, TaylorsFiniteFormFollowsTheEye) {
  for (unsigned seed = 0; seed < kTriangles; ++seed) {
    OneTriangle t = random_triangle(15, seed);
    t.light_from(Vec3(0.3, -0.2, 1));
    t.eye_at(Vec3(80, 50, 1000));
    EXPECT_LE(largest_difference(t, "taylor-local"), 2) << "seed " << seed;
  }
}

TEST(ShadingMethods, GouraudIsPhongAtTheCorners) {
  OneTriangle t = random_triangle(60, 3);
  t.light_from(Vec3(0.2, 0.1, 1));
  t.corner(0, 100.5, 60.5, t.triangle.vertices[0].normal);
  t.scene.lights.push_back(t.scene.lights[0]);
  t.scene.lights[1].direction = Vec3(-0.6, 0, -0.8);
  t.scene.lights[1].color = Color(0.1, 0.2, 0.3);
  t.eye_at(Vec3(10, 20, 300));
  Color phong, gouraud;
  t.shader("phong")->shade(100, 60, 1, &phong);
  t.shader("gouraud")->shade(100, 60, 1, &gouraud);
  EXPECT_LE((phong - gouraud).abs().maxCoeff(), kRounding);
}

TEST(ShadingMethods, FlatIsOneColour) {
  const OneTriangle t = random_triangle(60, 5);
  const auto row = middle_row(t, "flat");
  for (const Reflection<double>& r : row) EXPECT_EQ(r.diffuse, row[0].diffuse);
  OneTriangle level;  // all normals along the polygon's own
  EXPECT_LE(largest_difference(level, "flat"), kRounding);
}

// Hast, section 3: Gouraud's diffuse component with the highlight of exact Phong shading.
TEST(ShadingMethods, HybridsHighlightIsExact) {
  for (unsigned seed = 0; seed < kTriangles; ++seed) {
    OneTriangle t = random_triangle(60, seed);
    t.scene.shading.highlight = Highlight::reflection;
    const auto hybrid = middle_row(t, "hybrid"), exact = middle_row(t, "duff-eq34");
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_NEAR(hybrid[i].highlight, exact[i].highlight, 1e-12);
    }
    t.material.diffuse = Color::Zero();
    t.light_from(Vec3(0, 0.1, 1));  // nowhere below the horizon, where Phong has no highlight
    EXPECT_LE(largest_difference(t, "hybrid"), kRounding);
  }
}

// Where interpolated normals vanish no method has an answer, but each has a colour.
TEST(ShadingMethods, OpposedNormalsGiveColoursInRange) {
  for (const ShadingMethod& method : shading_methods()) {
    for (const double tilt : {0.0, 1e-9, 0.1}) {
      OneTriangle t = scene_for(method, 5, 1);
      if (refusal(method, t.scene, {t.material})) continue;
      t.corner(0, 100, 60, Vec3(1, 0, tilt));
      t.corner(1, 60, 130, Vec3(-0.5, std::sqrt(0.75), tilt));
      t.corner(2, 140, 120, Vec3(-0.5, -std::sqrt(0.75), tilt));
      const auto shader = t.shader(method.name);
      std::vector<Color> row(256);
      OneTriangle::for_each_span([&](int x, int y, int length) {
        shader->shade(x, y, length, row.data());
        for (std::size_t i = 0; i < static_cast<std::size_t>(length); ++i) {
          EXPECT_TRUE((row[i] >= 0).all() && (row[i] <= 255).all()) << method.name;
        }
      });
      const bool series = method.name == "taylor" || method.name == "taylor-local";
      // Fits sample the normals at points of their own, any of which may vanish or not.
      const bool fitted = method.source.find("quadratics") != std::string_view::npos;
      if (fitted && tilt < 0.1) continue;
      EXPECT_EQ(shader->exact_spans() > 0, series && tilt < 0.1) << method.name;
    }
  }
}

TEST(ShadingMethods, HighlightsStayDarkWhereTheLightDoesNotReach) {
  for (const ShadingMethod& method : shading_methods()) {
    OneTriangle t = scene_for(method, 5, 1);
    t.light_from(Vec3(1, 0, -0.2));
    if (refusal(method, t.scene, {t.material})) continue;
    Color color;
    t.shader(method.name)->shade(100, 100, 1, &color);
    EXPECT_EQ(color.maxCoeff(), 0) << method.name;
  }
}

}  // namespace
}  // namespace phongpipe
