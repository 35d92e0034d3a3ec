// Arithmetic of reduced precision: exact roundings, and formulas that lose as much as they should.
#include "model/shading/rounded.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testbench/system/random.h"

namespace phongpipe {
namespace {

TEST(Rounded, RoundsToNearestWithTiesToEven) {
  const Rounded::Precision precision(8);  // numbers from 256 to 511 are whole
  EXPECT_EQ(Rounded(256.5).value(), 256);
  EXPECT_EQ(Rounded(257.5).value(), 258);
  EXPECT_EQ(Rounded(-257.5).value(), -258);
  EXPECT_EQ(Rounded(257.4999).value(), 257);
  EXPECT_EQ(Rounded(511.5).value(), 512) << "a carry goes into the exponent";
  EXPECT_EQ(Rounded(0.0).value(), 0);
  EXPECT_EQ(Rounded(std::ldexp(1.0, -300)).value(), std::ldexp(1.0, -300));
  EXPECT_TRUE(std::isinf(Rounded(INFINITY).value()));
  EXPECT_TRUE(std::isnan(Rounded(NAN).value()));
}

TEST(Rounded, EveryOperationIsRounded) {
  const Rounded::Precision precision(8);
  const Rounded third = Rounded(1) / Rounded(3);
  EXPECT_EQ(third.value(), 341.0 / 1024);
  EXPECT_EQ((Rounded(256) + third).value(), 256);
  EXPECT_EQ((Rounded(257) * Rounded(257)).value(), 257.0 * 256 + 256) << "66049 lies between";
  EXPECT_EQ(rsqrt(Rounded(4)).value(), 0.5);
  EXPECT_EQ(rsqrt(Rounded(2)).value(), 362.0 / 512);
  EXPECT_EQ(power(Rounded(0.5), Rounded(3)).value(), 0.125);
  EXPECT_EQ(half(third).value(), 341.0 / 2048);
  EXPECT_EQ(twice(third).value(), 341.0 / 512);
  EXPECT_EQ((-third).value(), -341.0 / 1024);
  EXPECT_EQ(maximum(third, Rounded(0.25)).value(), third.value());
}

TEST(Rounded, WithAllBitsItIsDouble) {
  Random random(20261129);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(-10, 10), b = random.uniform(-10, 10);
    EXPECT_EQ((Rounded(a) * Rounded(b) + Rounded(a)).value(), a * b + a);
  }
}

}  // namespace
}  // namespace phongpipe
