// Random numbers: the same everywhere, in their range and without a bias.
#include "testbench/system/random.h"

#include <gtest/gtest.h>

#include <array>
#include <climits>

namespace phongpipe {
namespace {

TEST(Random, IsTheSameEverywhere) {
  Random random(5489);
  for (int i = 0; i < 9999; ++i) random.bits();
  EXPECT_EQ(static_cast<std::uint64_t>(random.bits()), 9981545732273789042U);  // of the standard
  // Computed by hand from the generator's next two numbers.
  EXPECT_EQ(random.integer(-1000, 1000), -302);
  EXPECT_EQ(random.uniform(-1, 3), 0x1.07f47686fccaep+0);
}

TEST(Random, IntegersReachTheEndsOfAnyRange) {
  Random random(1);
  std::array<int, 3> count{};
  for (int i = 0; i < 30000; ++i) ++count.at(static_cast<std::size_t>(random.integer(-1, 1) + 1));
  for (const int times : count) EXPECT_NEAR(times, 10000, 400);  // five standard deviations
  EXPECT_EQ(random.integer(7, 7), 7);
  int lowest = INT_MAX, highest = INT_MIN;
  for (int i = 0; i < 1000; ++i) {
    const int value = random.integer(INT_MIN, INT_MAX);
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  EXPECT_LT(lowest, INT_MIN / 100 * 95);
  EXPECT_GT(highest, INT_MAX / 100 * 95);
}

TEST(Random, RealNumbersAreEvenlySpread) {
  Random random(2);
  double sum = 0, squares = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.uniform(-3, 5);
    ASSERT_GE(value, -3);
    ASSERT_LT(value, 5);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 1, 0.04);
  EXPECT_NEAR(squares / kCount, 1 + 64.0 / 12, 0.1);
}

TEST(Random, UnitVectorsAreOfLengthOneAndWithinTheirAngle) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis = random.unit(), near = random.unit_near(axis, 25);
    EXPECT_NEAR(axis.norm(), 1, 1e-15);
    EXPECT_NEAR(near.norm(), 1, 1e-15);
    EXPECT_GE(axis.dot(near), std::cos(25 * 3.14159265358979323846 / 180) - 1e-15);
  }
}

}  // namespace
}  // namespace phongpipe
