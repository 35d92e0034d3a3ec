// What the sources print and is wrong (model/shading/ERRATA.md), except the coefficients of the
// Taylor series and Hast et al., which have files of their own. Every test fails on the printed
// form.
#include <gtest/gtest.h>

#include "model/shading/methods/angle_interpolation.h"
#include "model/shading/methods/forward_differences.h"
#include "testbench/tests/model/shading/methods/errata.h"
#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

TEST(Errata, DuffsDenominatorIsTheLengthOfTheNormal) {
  OneTriangle t = random_triangle(60, 7);
  t.light_from(Vec3(1, 0.5, 0.6));
  const ShadingInput<double> in = input(t);
  const Vec3 n = interpolated_normal(in).c;
  const double exact = n.normalized().dot(in.light);
  const OriginPixel origin = centroid_pixel(t.triangle);
  EXPECT_NEAR(at(t, "duff", origin.x, origin.y).diffuse, exact, 1e-12);
  // |L| |L·A x + L·B y + L·C|: the quotient is 1 everywhere.
  EXPECT_GT(std::abs(n.dot(in.light) / std::abs(in.light.dot(n)) - exact), kLarge);
}

TEST(Errata, DuffsFirstFormDividesByTheLightsLengthOnce) {
  const Vec3 light(0.6, 0, 1.6), n(0, 0, 0.9);
  const double exact = n.normalized().dot(light.normalized());
  const double corrected = light.dot(n) / (light.norm() * n.norm());
  const double printed = (light / light.norm()).dot(n) / (light.norm() * n.norm());
  EXPECT_NEAR(corrected, exact, 1e-15);
  EXPECT_GT(std::abs(printed - exact), kLarge);
}

TEST(Errata, TheAbstractsCostOfPhongIsDuffs) {
  const OperationCounts printed = {3, 0, 0, 1, 1, 0};
  const auto pixel = [](const char* method) {
    return find_shading_method(method)->costs(Parts::diffuse, PowerKind::table).pixel;
  };
  EXPECT_EQ(pixel("duff"), printed);
  EXPECT_NE(pixel("phong"), printed);
  EXPECT_EQ(pixel("phong"), (OperationCounts{7, 6, 0, 1, 1, 0}));
}

// "A table of 1k bytes … with less than 1 percent error" for n = 20: wherever an interval's word is
// taken, rounding it to a byte brings the error above 1 %.
TEST(Errata, BytesDoNotHoldThePowersToOnePercent) {
  constexpr int kWords = 1024;
  for (const double middle : {0.4, 0.5, 0.6}) {
    double words = 0, bytes = 0;
    for (int i = 0; i < kWords; ++i) {
      const double word = std::pow((i + middle) / kWords, 20);
      for (const int end : {i, i + 1}) {
        const double exact = std::pow(static_cast<double>(end) / kWords, 20);
        words = std::max(words, std::abs(word - exact));
        bytes = std::max(bytes, std::abs(std::round(255 * word) / 255 - exact));
      }
    }
    EXPECT_GT(bytes, 0.0105);
    EXPECT_LT(middle == 0.5 ? words : 0, 0.00973);
  }
}

// The colour of a surface edge-on to the light is its ambient one, not its highlight's.
TEST(Errata, OtmsColourStartsFromTheAmbientComponent) {
  OneTriangle t;
  t.scene.shading.ambient_light = Color::Ones();
  t.material.ambient = Color::Constant(0.1);
  t.light_from(Vec3(1, 0, -1e-9));
  Color color;
  t.shader("otm")->shade(100, 100, 1, &color);
  EXPECT_NEAR(color[0], 255 * 0.1, 1e-9);
  EXPECT_GT(std::abs(color[0] - 255 * t.material.specular[0]), 50);
}

TEST(Errata, OtmsCosineSeries) {
  const auto sum = [](double x, bool printed) {
    double total = printed ? x : 1, term = 1;
    for (int n = 1; n < 12; ++n) {
      term *= -x * x / ((2 * n - 1) * (2 * n));
      total += printed && n > 1 ? -term : term;  // (−1)ⁿ⁻¹ from the general term on
    }
    return total;
  };
  for (int byte = 0; byte <= kRightAngle; byte += 15) {
    const double x = byte * 90.0 / kRightAngle * kDegree;
    EXPECT_NEAR(sum(x, false), lookup(cosine_table(), byte), 1e-12);
  }
  EXPECT_GT(std::abs(sum(0, true) - lookup(cosine_table(), 0)), kLarge);
}

// "The first two terms … are sufficient … from x = 0 to x = 90."
TEST(Errata, OtmsTwoTermsOfTheCosineDoNotReachARightAngle) {
  const double right = 90 * kDegree;
  EXPECT_NEAR(1 - right * right / 2, -0.2337, 1e-4);
  EXPECT_EQ(lookup(cosine_table(), kRightAngle), 0);
}

TEST(Errata, OtmsCostOfPhong) {
  const OperationCounts interpolation = {3, 0, 0, 0, 0, 0}, printed = {2, 4, 0, 1, 1, 0};
  const OperationCounts measured =
      find_shading_method("phong")->costs(Parts::diffuse, PowerKind::table).pixel;
  EXPECT_NE(measured, interpolation + printed);
  EXPECT_EQ(measured, interpolation + (OperationCounts{4, 6, 0, 1, 1, 0}));
}

// "Correct in 99% of all possible cases … not when the angles at any two or more vertices are
// equal": unequal angles on either side of the light lose the highlight too.
TEST(Errata, OtmLosesHighlightsBetweenUnequalAngles) {
  OneTriangle t;
  t.light_from(Vec3(0, 0, 1));
  const std::array<double, 3> lean = {18, 25, 32};
  for (std::size_t i = 0; i < 3; ++i) {
    const double turn = 120 * kDegree * static_cast<double>(i), angle = lean[i] * kDegree;
    t.triangle.vertices[i].normal =
        Vec3(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle));
  }
  double otm = 0, phong = 0;
  OneTriangle::for_each_span([&](int x, int y, int length) {
    for (int i = 0; i < length; ++i) {
      otm = std::max(otm, at(t, "otm", x + i, y).highlight);
      phong = std::max(phong, at(t, "duff", x + i, y).highlight);
    }
  });
  EXPECT_GT(phong, 0.999);
  EXPECT_LT(otm, std::cos(17 * kDegree));
}

// "Eliminates the need to check for negative values."
TEST(Errata, TheTutorialsHalfwayCosineNeedsClampAndGate) {
  const Vec3 n(0, 0, 1), eye = Vec3(0.2, 0, 1).normalized();
  const Vec3 from_below = Vec3(1, 0, -0.2).normalized(), behind = Vec3(0, 0.1, -2).normalized();
  EXPECT_LT(n.dot(from_below), 0);
  EXPECT_GT(n.dot((from_below + eye).normalized()), kLarge);  // a highlight without light
  EXPECT_LT(n.dot((behind + Vec3(1, 0, 0.2).normalized()).normalized()), -kLarge);
  OneTriangle t;
  t.light_from(from_below);
  Color color;
  t.shader("duff")->shade(100, 100, 1, &color);
  EXPECT_EQ(color.maxCoeff(), 0);
}

// "The light vector l points down … r will point straight back": r = −l + 2 (l·n) n wants l from
// the surface to the light.
TEST(Errata, TheTutorialsLightVectorPointsToTheLight) {
  const Vec3 n(0, 0, 1);
  EXPECT_NEAR(mirrored(Vec3(0, 0, 1), n).z(), 1, 1e-15);
  EXPECT_NEAR(mirrored(Vec3(0, 0, -1), n).z(), -1, 1e-15);  // printed: into the mirror
}

// Nettle's (R·V)^n has no clamp: an even n lights what faces away.
TEST(Errata, NettlesPowerNeedsAClamp) {
  EXPECT_EQ(Power(PowerKind::exact, 2)(-0.8), 0);
  EXPECT_GT(std::pow(-0.8, 2), 0.6);
}

}  // namespace
}  // namespace phongpipe
