// Powers by squaring are those of the library, within the error that the header states.
#include "model/shading/exact_power.h"

#include <gtest/gtest.h>

#include "testbench/system/random.h"

namespace phongpipe {
namespace {

TEST(ExactPower, IsWithinItsBound) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 20'000; ++i) {
    const double n = random.integer(0, 1024), x = 1 - random.uniform(0, 0.5) * (i % 2);
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(n));
    const long double error = std::fabs(exact_power(x, n) - exact);
    ASSERT_LE(error, static_cast<long double>(n) * 0x1p-53L * exact + 0x1p-1022L) << x << "^" << n;
  }
}

TEST(ExactPower, OfAnyExponent) {
  EXPECT_EQ(exact_power(0, 0), 1);
  EXPECT_EQ(exact_power(0, 20), 0);
  EXPECT_EQ(exact_power(1, 1e9), 1);
  EXPECT_EQ(exact_power(0.25, 0.5), 0.5);
  EXPECT_EQ(exact_power(0.9999, 10'000), std::pow(0.9999, 10'000));
}

}  // namespace
}  // namespace phongpipe
