// Registers of run-time width: rounding, wrapping and what is flagged.
#include "model/fixed/fixed_point.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace phongpipe {
namespace {

constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

std::int64_t fixed(double value, int fraction_bits) {
  bool overflow = false;
  const std::int64_t result = to_fixed(value, fraction_bits, overflow);
  EXPECT_FALSE(overflow) << value << " with " << fraction_bits << " fraction bits";
  return result;
}

TEST(ToFixed, RoundsToNearestAndTiesAwayFromZero) {
  EXPECT_EQ(fixed(1.5, 0), 2);
  EXPECT_EQ(fixed(2.5, 0), 3);
  EXPECT_EQ(fixed(-2.5, 0), -3);
  EXPECT_EQ(fixed(-0.5, 0), -1);
  EXPECT_EQ(fixed(std::nextafter(0.5, 0), 0), 0);
  EXPECT_EQ(fixed(0.125, 3), 1);
  EXPECT_EQ(fixed(0.0625, 3), 1);
  EXPECT_EQ(fixed(0.0624, 3), 0);
  EXPECT_EQ(fixed(-0.0, 20), 0);
}

TEST(ToFixed, FlagsWhatDoesNotFitAndGivesZero) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {infinity, -infinity, nan, 0x1p42, -0x1p42, 1e300}) {
    bool overflow = false;
    EXPECT_EQ(to_fixed(value, 20, overflow), 0) << value;
    EXPECT_TRUE(overflow) << value;
  }
  EXPECT_EQ(fixed(std::nextafter(0x1p42, 0), 20), (std::int64_t{1} << 62) - (1 << 9));
  EXPECT_EQ(fixed(std::nextafter(-0x1p42, 0), 20), -(std::int64_t{1} << 62) + (1 << 9));
}

TEST(ToFixed, DoesNotTakeAFlagBack) {
  bool overflow = true;
  to_fixed(1, 0, overflow);
  EXPECT_TRUE(overflow);
}

TEST(RoundOff, RoundsToNearestAndTiesUp) {
  EXPECT_EQ(round_off(7, 0), 7);
  EXPECT_EQ(round_off(5, 1), 3);
  EXPECT_EQ(round_off(-5, 1), -2);
  EXPECT_EQ(round_off(-6, 2), -1);
  EXPECT_EQ(round_off(-7, 2), -2);
  EXPECT_EQ(round_off(6, 2), 2);
  EXPECT_EQ(round_off(kMin, 20), kMin >> 20);
}

RC_GTEST_PROP(RoundOff, IsNeverFurtherThanAHalf, (std::int64_t value)) {
  const int bits = *rc::gen::inRange(1, 41);
  value >>= 2;  // where the product below has room
  const std::int64_t error = (round_off(value, bits) * (std::int64_t{1} << bits)) - value;
  const std::int64_t half = std::int64_t{1} << (bits - 1);
  RC_ASSERT(-half < error && error <= half);
}

TEST(WrapTo, KeepsTheLowBitsSignExtended) {
  EXPECT_EQ(wrap_to(7, 4), 7);
  EXPECT_EQ(wrap_to(8, 4), -8);
  EXPECT_EQ(wrap_to(-9, 4), 7);
  EXPECT_EQ(wrap_to(16, 4), 0);
  EXPECT_EQ(wrap_to(1, 1), -1);
  EXPECT_EQ(wrap_to(kMin, 64), kMin);
  EXPECT_EQ(wrap_to(kMax, 63), -1);
}

RC_GTEST_PROP(WrapTo, IsCongruentAndInRange, (std::int64_t value)) {
  const int width = *rc::gen::inRange(1, 64);
  const std::int64_t wrapped = wrap_to(value, width);
  const std::int64_t limit = std::int64_t{1} << (width - 1);
  RC_ASSERT(-limit <= wrapped && wrapped < limit);
  const std::uint64_t difference =
      static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(wrapped);
  RC_ASSERT(difference << (64 - width) == 0U);
  RC_ASSERT(fits(value, width) == (wrapped == value));
  RC_ASSERT(fits(wrapped, width));
}

TEST(Wrapping, AdditionAndMultiplicationAreModulo64Bits) {
  EXPECT_EQ(wrap_add(kMax, 1), kMin);
  EXPECT_EQ(wrap_add(kMin, -1), kMax);
  EXPECT_EQ(wrap_mul(kMin, -1), kMin);
  EXPECT_EQ(wrap_mul(kMax, 2), -2);
  EXPECT_EQ(wrap_mul(-3, 5), -15);
}

}  // namespace
}  // namespace phongpipe
