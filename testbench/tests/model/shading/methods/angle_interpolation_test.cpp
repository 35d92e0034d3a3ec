// OTMPHONG's interpolation of angles: right where normals turn about one axis, in steps of a byte.
#include <gtest/gtest.h>

#include "model/shading/methods/angle_interpolation.h"
#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

constexpr double kByte = 90.0 / kRightAngle * kDegree;  // radians

// Normals that lean to the right by these angles, in degrees; the light comes from +z.
OneTriangle turning(double left, double middle, double right) {
  const auto leaning = [](double degrees) {
    return Vec3(std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree));
  };
  OneTriangle t;
  t.light_from(Vec3(0, 0, 1));
  t.corner(0, 100, 60, leaning(middle));
  t.corner(1, 60, 130, leaning(left));
  t.corner(2, 140, 120, leaning(right));
  return t;
}

double interpolated(const OneTriangle& t, double a0, double a1, double a2, int x, int y) {
  const auto& v = t.triangle.vertices;
  const auto at = [&v](std::size_t i) {
    return std::array<double, 2>{in_pixels(v[i].x), in_pixels(v[i].y)};
  };
  const Interpolator<double> interpolate({at(0)[0], at(1)[0], at(2)[0]},
                                         {at(0)[1], at(1)[1], at(2)[1]});
  const Linear<double> angle = interpolate(a0, a1, a2);
  return angle.a * (x + 0.5) + angle.b * (y + 0.5) + angle.c;
}

// Half a byte where a corner's angle is rounded, half where the table is addressed.
TEST(AngleInterpolation, FollowsTheCosineOfALinearAngleWithinAByte) {
  const OneTriangle t = turning(5, 45, 85);
  const auto shader = t.shader("otm");
  OneTriangle::for_each_span([&](int x, int y, int length) {
    std::vector<Reflection<double>> row(static_cast<std::size_t>(length));
    shader->reflect(x, y, length, row.data());
    for (int i = 0; i < length; ++i) {
      const double angle = interpolated(t, 45, 5, 85, x + i, y) * kDegree;
      EXPECT_NEAR(row[static_cast<std::size_t>(i)].diffuse, std::cos(angle), kByte);
    }
  });
}

// Linear normals turn faster in the middle of an edge, by at most 0.25° at 30°.
TEST(AngleInterpolation, AgreesWithPhongWhereNormalsTurnAboutOneAxis) {
  const OneTriangle t = turning(40, 55, 70);
  const auto otm = t.shader("otm"), phong = t.shader("duff");
  OneTriangle::for_each_span([&](int x, int y, int length) {
    std::vector<Reflection<double>> a(static_cast<std::size_t>(length)), b = a;
    otm->reflect(x, y, length, a.data());
    phong->reflect(x, y, length, b.data());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i].diffuse, b[i].diffuse, kByte + 0.25 * kDegree);
    }
  });
}

// The source: corners at equal angles give one solid colour, the highlight between them is lost.
TEST(AngleInterpolation, LosesTheHighlightBetweenEqualAngles) {
  OneTriangle t;
  t.light_from(Vec3(0, 0, 1));
  for (std::size_t i = 0; i < 3; ++i) {
    const double turn = 120 * kDegree * static_cast<double>(i);
    const double lean = 25 * kDegree;
    t.triangle.vertices[i].normal =
        Vec3(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), std::cos(lean));
  }
  std::vector<Reflection<double>> otm(30), phong(30);
  t.shader("otm")->reflect(85, 103, 30, otm.data());
  t.shader("duff")->reflect(85, 103, 30, phong.data());
  double brightest = 0;
  for (std::size_t i = 0; i < otm.size(); ++i) {
    EXPECT_EQ(otm[i].highlight, otm[0].highlight);
    EXPECT_NEAR(otm[i].highlight, std::cos(25 * kDegree), kByte);
    brightest = std::max(brightest, phong[i].highlight);
  }
  EXPECT_GT(brightest, 0.999);
}

TEST(AngleInterpolation, AnglesBeyondARightAngleStayThere) {
  EXPECT_EQ(angle_byte(1.0), 0);
  EXPECT_EQ(angle_byte(1.0000001), 0);
  EXPECT_EQ(angle_byte(0.0), kRightAngle);
  EXPECT_EQ(angle_byte(-0.5), kRightAngle);
  EXPECT_NEAR(lookup(cosine_table(), angle_byte(0.5)), 0.5, kByte / 2);
}

}  // namespace
}  // namespace phongpipe
