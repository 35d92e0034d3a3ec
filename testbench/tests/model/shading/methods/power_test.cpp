// Approximate powers: largest absolute errors over [0, 1].
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "model/shading/methods/power.h"
#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

double largest_error(PowerKind kind, double n) {
  const Power power(kind, n), exact(PowerKind::exact, n);
  constexpr int kSamples = 1 << 20;
  double largest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double x = static_cast<double>(i) / kSamples;
    largest = std::max(largest, std::abs(power(x) - exact(x)));
  }
  return largest;
}

TEST(Power, LargestErrorsOfSchlickAndLyon) {
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::schlick, 20)), "0.191");
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::schlick, 164)), "0.202");
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::lyon4, 20)), "0.060");
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::lyon8, 20)), "0.022");
  EXPECT_EQ(fmt::format("{:.4f}", largest_error(PowerKind::lyon16, 20)), "0.0035");
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::lyon4, 164)), "0.072");
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::lyon8, 164)), "0.034");
  EXPECT_EQ(fmt::format("{:.3f}", largest_error(PowerKind::lyon16, 164)), "0.016");
}

// n/(2N): an entry serves the half steps on either side of it.
TEST(Power, TableIsGoodToHalfAStep) {
  EXPECT_NEAR(largest_error(PowerKind::table, 20), 20 / (2 * 1023.0), 2e-4);
}

TEST(Power, EndsAreExact) {
  for (const PowerKind kind : power_kinds()) {
    EXPECT_DOUBLE_EQ(Power(kind, 50)(1), 1) << name(kind);
    EXPECT_EQ(Power(kind, 50)(0), 0) << name(kind);
    EXPECT_EQ(Power(kind, 50)(-0.5), 0) << name(kind);
  }
}

TEST(Power, ChangesTheHighlightOfAMethod) {
  OneTriangle t;
  t.light_from(Vec3(0.2, 0, 1));
  const double schlick = largest_difference(t, "duff", "phong", PowerKind::schlick);
  EXPECT_GT(schlick, 0.01);
  EXPECT_LE(schlick, 255 * 0.4 * 0.1911);
  EXPECT_LE(largest_difference(t, "duff", "phong", PowerKind::table), 255 * 0.4 * 0.0098);
}

}  // namespace
}  // namespace phongpipe
