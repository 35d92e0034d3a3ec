// What Hast, Barrera & Bengtsson print and is wrong (model/shading/ERRATA.md). Every test fails on
// the printed form.
#include <gtest/gtest.h>

#include "model/shading/methods/reflection_shading.h"
#include "testbench/tests/model/shading/methods/errata.h"
#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

// Eq. 30 as far as the scan shows it: without the parentheses the middle coefficient is wrong.
TEST(HastErrata, Equation30) {
  const Linear<double> p = {0.3, 0, 0.8}, q = {-0.2, 0, 0.5};
  const Quadratic<double> product = doubled(p) * q;
  const double x = 1.7, exact = 2 * (p.a * x + p.c) * (q.a * x + q.c);
  EXPECT_NEAR(product(x, 0), exact, 1e-15);
  EXPECT_NEAR(product.t2, 2 * (p.a * q.c + p.c * q.a), 1e-15);
  EXPECT_GT(std::abs((2 * p.a * q.c + p.c * q.a) - product.t2), kLarge);
}

// Eq. 22: (LzD − A1A2) x² + (LzE − A1B2 − A2B1) x + (LzF − B1B2), here with V = (0, 0, −1) as
// there.
TEST(HastErrata, Equation22) {
  const Vec3 k(0.02, -0.01, 0.015), m(0.2, 0.3, -0.9), l = Vec3(0.3, -0.2, -1).normalized();
  const Vec3 v(0, 0, -1);
  const double a1 = k.dot(l), b1 = m.dot(l), a2 = 2 * k.z(), b2 = 2 * m.z();
  const double d = k.dot(k), e = 2 * k.dot(m), f = m.dot(m), x = 9;
  const double numerator =
      (l.z() * d - a1 * a2) * x * x + (l.z() * e - a1 * b2 - a2 * b1) * x + (l.z() * f - b1 * b2);
  const Vec3 n = (k * x + m).normalized();
  EXPECT_NEAR(numerator / (d * x * x + e * x + f), mirrored(l, n).dot(v), 1e-15);

  ShadingInput<double> in;
  in.light = l;
  in.viewer = v;
  in.light_dot_viewer = l.dot(v);
  const Linear<Vector3<double>> normal = {k, Vec3::Zero(), m};
  EXPECT_NEAR(mirror_numerator(in, normal, dot(normal, in.light), square(normal))(x, 0), numerator,
              1e-14);
}

// "E = 1, since m has unit length": an interpolated edge normal has not. Normalised again along the
// edges, the normal is another one than Phong's.
TEST(HastErrata, SpansDoNotStartFromUnitNormals) {
  OneTriangle t;
  t.light_from(Vec3(0.3, 0.2, 1));
  t.corner(0, 100, 60, Vec3(0, 0.9, 1));
  t.corner(1, 60, 130, Vec3(-1, -0.4, 1));
  t.corner(2, 140, 120, Vec3(1, -0.4, 1));
  const ShadingInput<double> in = input(t);
  const Linear<Vec3> normal = interpolated_normal(in);
  const Vec3 m = normal.a * -15 + normal.c;  // where the row through the origin starts
  const double exact = m.dot(in.light) / m.norm();
  const OriginPixel origin = centroid_pixel(t.triangle);
  EXPECT_NEAR(at(t, "duff", origin.x - 15, origin.y).diffuse, exact, 1e-12);
  EXPECT_GT(std::abs(m.dot(in.light) / std::sqrt(1.0) - exact), kLarge);
}

// Largest angle between Phong's normal and one interpolated along spans whose ends, anywhere on two
// edges, are normalised.
double largest_turn(const std::array<Vec3, 3>& corner) {
  double largest = 0;
  for (double v = 0.1; v < 1.05; v += 0.1) {
    for (double w = 0.1; w < 1.05; w += 0.1) {
      const Vec3 left = corner[0] * (1 - v) + corner[1] * v;
      const Vec3 right = corner[0] * (1 - w) + corner[2] * w;
      for (double u = 0.05; u < 1; u += 0.05) {
        const Vec3 phong = left * (1 - u) + right * u;
        const Vec3 renormalised = left.normalized() * (1 - u) + right.normalized() * u;
        largest = std::max(largest,
                           std::atan2(phong.cross(renormalised).norm(), phong.dot(renormalised)));
      }
    }
  }
  return largest / kDegree;
}

TEST(HastErrata, EdgeNormalsOfUnitLengthTurnTheNormalByTwoDegrees) {
  const auto lean = [](double degrees, double turn) {
    return Vec3(std::sin(degrees * kDegree) * std::cos(turn * kDegree),
                std::sin(degrees * kDegree) * std::sin(turn * kDegree),
                std::cos(degrees * kDegree));
  };
  double largest = 0;
  for (const double first : {30.0, 60.0}) {
    for (int second = 0; second <= 60; second += 5) {
      for (int turn = 0; turn <= 180; turn += 5) {
        const std::array<Vec3, 3> corner = {lean(0, 0), lean(first, 0), lean(second, turn)};
        if (corner[1].dot(corner[2]) < 0.5 - 1e-9) continue;  // no two more than 60° apart
        largest = std::max(largest, largest_turn(corner));
      }
    }
  }
  EXPECT_NEAR(largest, 2.1, 0.05);
}

// "The angle between N and H is always smaller than the angle between R and V": true in one plane.
TEST(HastErrata, TheHalfwayAngleMayBeTheLargerOne) {
  const auto angle = [](const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  };
  const Vec3 l = Vec3(1, 0, 0.1).normalized(), v = Vec3(-1, 0, 0.1).normalized();
  const Vec3 n = Vec3(0, 1, 0.05).normalized();
  EXPECT_GT(n.dot(l), 0);
  EXPECT_GT(angle(n, (l + v).normalized()), angle(mirrored(l, n), v));
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 a = direction_within(90, random), b = direction_within(90, random);
    const Vec3 c = direction_within(90, random);
    EXPECT_LE(angle(mirrored(a, c), b), 2 * angle(c, (a + b).normalized()) + 1e-9);
  }
}

OneTriangle lit_from(const Vec3& position, double unit) {
  OneTriangle t = random_triangle(20, 4);
  t.scene.shading.highlight = Highlight::reflection;
  t.scene.lights[0].type = LightType::point;
  t.scene.lights[0].position = position * unit;
  for (ScreenVertex& v : t.triangle.vertices) v.position *= unit;
  return t;
}

// Eqs. 36–38: the mirrored vector depends on the length of L, that is on the unit of the scene.
TEST(HastErrata, MirroredVectorsDoNotDependOnTheScenesUnit) {
  const Vec3 position(40, 60, 300);
  const OneTriangle large = lit_from(position, 1), small = lit_from(position, 0.001);
  for (int x = 90; x < 110; ++x) {
    const Reflection<double> a = at(large, "point-reflection", x, 100);
    const Reflection<double> b = at(small, "point-reflection", x, 100);
    EXPECT_NEAR(a.diffuse, b.diffuse, 1e-12);
    EXPECT_NEAR(a.highlight, b.highlight, 1e-12);
  }
  const auto printed = [](const Vec3& s, const Vec3& l) {
    return mirrored(s, (s + l).normalized());
  };
  const Vec3 s(0, 0, 1), l(0.5, 0, 1);
  EXPECT_GT((printed(s, l) - printed(s, 300 * l)).norm(), kLarge);
  EXPECT_GT((printed(s, l) - printed(s, 0.001 * l)).norm(), kLarge);
}

// "The width of the spot … will be smaller": only for vectors longer than S; shorter ones widen it.
TEST(HastErrata, SpotIsNotAlwaysNarrower) {
  const auto cosine = [](const Vec3& l) {
    const Vec3 s(0, 0, 1);
    return mirrored(s, (s + l).normalized()).dot(s);  // eq. 37
  };
  const Vec3 l = Vec3(0.5, 0, 1).normalized();
  EXPECT_NEAR(cosine(l), l.z(), 1e-15);
  EXPECT_LT(cosine(3 * l), l.z() - kLarge);
  EXPECT_GT(cosine(0.3 * l), l.z() + kLarge);
}

}  // namespace
}  // namespace phongpipe
