// Truncated power series as values: each operation against the identity that defines it.
#include "model/shading/quadratics/truncated_series.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "testbench/tests/model/shading/six.h"

namespace phongpipe {
namespace {

using Series = Quadratic<double>;

constexpr int kSize = 1000;  // products of such numbers and sums of them are exact

Series whole_numbers() {
  const auto any = [] { return static_cast<double>(*rc::gen::inRange(-kSize, kSize)); };
  return {any(), any(), any(), any(), any(), any()};
}
// Value 0.5 to 2, other coefficients up to 1.
Series positive() {
  const auto any = [] { return *rc::gen::inRange(-kSize, kSize) / static_cast<double>(kSize); };
  return {1.25 + 0.75 * any(), any(), any(), any(), any(), any()};
}

void expect_near(const Series& a, const Series& b) {
  for (std::size_t i = 0; i < 6; ++i) RC_ASSERT(std::fabs(six(a)[i] - six(b)[i]) < 1e-11);
}

RC_GTEST_PROP(TruncatedSeries, OfLinearFunctionsIsTheirProduct, ()) {
  Series p = whole_numbers(), q = whole_numbers();
  p.t3 = p.t4 = p.t5 = q.t3 = q.t4 = q.t5 = 0;
  for (const double x : {-3.0, 0.0, 1.0, 2.0}) {
    for (const double y : {-2.0, 0.0, 1.0, 5.0}) {
      RC_ASSERT((p * q)(x, y) == p(x, y) * q(x, y));
      RC_ASSERT((p + q)(x, y) == p(x, y) + q(x, y));
      RC_ASSERT((p - q)(x, y) == p(x, y) - q(x, y));
    }
  }
}

RC_GTEST_PROP(TruncatedSeries, AreARing, ()) {
  const Series p = whole_numbers(), q = whole_numbers(), r = whole_numbers();
  RC_ASSERT(six(p * q) == six(q * p));
  RC_ASSERT(six((p * q) * r) == six(p * (q * r)));
  RC_ASSERT(six(p * (q + r)) == six(p * q + p * r));
  RC_ASSERT(six(twice(p)) == six(p + p));
  RC_ASSERT(six(p * 7.0) == six(p * Series{7, 0, 0, 0, 0, 0}));
  RC_ASSERT(six(p - 7.0) == six(p + -7.0));
}

TEST(TruncatedSeries, DropWhatIsOfThirdDegree) {
  const Series squares = {0, 0, 0, 1, 2, 3}, lines = {0, 4, 5, 0, 0, 0};
  EXPECT_EQ(six(squares * lines), Six{});
  EXPECT_EQ(six(squares * squares), Six{});
}

RC_GTEST_PROP(TruncatedSeries, RootsPowersAndReciprocalsAreInverses, ()) {
  const Series x = positive(), one = {1, 0, 0, 0, 0, 0};
  expect_near(rsqrt(x) * rsqrt(x) * x, one);
  expect_near(reciprocal(x) * x, one);
  expect_near(power(x, 3.0), x * x * x);
  expect_near(power(x, -0.5), rsqrt(x));
  expect_near(power(power(x, 1.0 / 3), 3.0), x);
  expect_near(power(x, 1.0), x);
  expect_near(power(x, 0.0), one);
}

TEST(TruncatedSeries, PowersOfWhatIsNotPositiveVanish) {
  for (const double value : {0.0, -1e-300, -0.5, -1e9}) {
    for (const double p : {0.006, 0.5, 1.0, 50.0}) {
      EXPECT_EQ(six(power(Series{value, 1, -2, 3, 4, -5}, p)), Six{}) << value << "^" << p;
    }
  }
}

TEST(TruncatedSeries, BoundsAreOfTheValue) {
  const Series q = {2, 1, 1, 1, 1, 1};
  EXPECT_EQ(at_least(3.0, q).t0, 3);
  EXPECT_EQ(at_most(1.0, q).t0, 1);
  EXPECT_EQ(six(at_least(1.0, q)), six(q));
  EXPECT_EQ(six(at_most(3.0, q)), six(q));
}

}  // namespace
}  // namespace phongpipe
