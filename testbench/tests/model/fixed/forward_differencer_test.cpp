// Forward differences are exact: stepping gives the value of the integer polynomial, so the model
// may evaluate the closed form and must still match the RTL to the bit.
#include "model/fixed/forward_differencer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace phongpipe {
namespace {

__extension__ using Wide = __int128;

// T5 x² + T4 xy + … + T0 without wrapping, for coefficients below 2^60 and coordinates below 2^13.
Wide exact_value(const FixedQuadratic& t, std::int64_t x, std::int64_t y) {
  return Wide{t.t5} * x * x + Wide{t.t4} * x * y + Wide{t.t3} * y * y + Wide{t.t2} * x +
         Wide{t.t1} * y + t.t0;
}
std::int64_t low_bits(Wide value, int width) {
  return wrap_to(static_cast<std::int64_t>(static_cast<std::uint64_t>(value)), width);
}

FixedQuadratic any_quadratic() {
  const auto coefficient = [] {
    return *rc::gen::arbitrary<std::int64_t>() >> *rc::gen::inRange(4, 60);
  };
  return {coefficient(), coefficient(), coefficient(), coefficient(), coefficient(), coefficient()};
}

SeriesStart start_of(const FixedQuadratic& t, std::int64_t x, std::int64_t y) {
  return {t.value(x, y), t.difference(x, y), wrap_mul(2, t.t5)};
}

TEST(ForwardDifferencer, StepsByHand) {
  ForwardDifferencer series(8);
  series.load({1, 3, 2});  // (i + 1)²
  for (const std::int64_t expected : {1, 4, 9, 16, 25, 36, 49, 64, 81, 100, 121, 144 - 256}) {
    EXPECT_EQ(series.v(), expected);
    series.step();
  }
}

TEST(ForwardDifferencer, LoadKeepsTheRegistersWidth) {
  ForwardDifferencer series(8);
  series.load({0x1ff, 0x101, 0x100});
  EXPECT_EQ(series.v(), -1);
  series.step();
  EXPECT_EQ(series.v(), 0);
  series.step();
  EXPECT_EQ(series.v(), 1);
}

RC_GTEST_PROP(ForwardDifferencer, SteppingEqualsTheClosedForm, ()) {
  const int width = *rc::gen::inRange(14, 41);
  const FixedQuadratic t = any_quadratic();
  const int x = *rc::gen::inRange(-4095, 4096), y = *rc::gen::inRange(-4095, 4096);
  ForwardDifferencer series(width);
  series.load(start_of(t, x, y));
  const int length = *rc::gen::inRange(1, 300);
  for (int i = 0; i < length; ++i) {
    RC_ASSERT(series.v() == low_bits(exact_value(t, x + i, y), width));
    series.step();
  }
}

RC_GTEST_PROP(ForwardDifferencer, WithoutBendItIsAStraightLine, ()) {
  const int width = *rc::gen::inRange(14, 41);
  const auto v = *rc::gen::arbitrary<std::int64_t>(), d1 = *rc::gen::arbitrary<std::int64_t>();
  ForwardDifferencer series(width);
  series.load({v, d1, 0});
  for (int i = 0; i < 100; ++i) {
    RC_ASSERT(series.v() == wrap_to(wrap_add(v, wrap_mul(d1, i)), width));
    series.step();
  }
}

// Datapaths that take turns along a span see what one would.
RC_GTEST_PROP(ForwardDifferencer, LanesTakeTurnsAlongASpan, ()) {
  const int width = *rc::gen::inRange(14, 41), lanes = *rc::gen::element(2, 4);
  const SeriesStart span = {*rc::gen::arbitrary<std::int64_t>(),
                            *rc::gen::arbitrary<std::int64_t>(),
                            *rc::gen::arbitrary<std::int64_t>()};
  ForwardDifferencer one(width);
  one.load(span);
  std::vector<ForwardDifferencer> turns;
  for (int lane = 0; lane < lanes; ++lane) {
    turns.emplace_back(width);
    turns.back().load(lane_start(span, lane, lanes));
  }
  for (int i = 0; i < 100; ++i, one.step()) {
    ForwardDifferencer& lane = turns[static_cast<std::size_t>(i % lanes)];
    RC_ASSERT(lane.v() == one.v());
    lane.step();
  }
}

// Ends below 0 and above 2^(width−1) on the way, and yet every value that fits is right.
TEST(ForwardDifferencer, IntermediatesMayWrapWhereTheValueFits) {
  const int width = 12;
  const FixedQuadratic t = {1000, 0, 400, 0, 0, -2};  // peaks at x = 100 at 21,000
  ForwardDifferencer series(width);
  series.load(start_of(t, 0, 0));
  int fitting_again = 0;
  bool left = false;
  for (int x = 0; x <= 210; ++x, series.step()) {
    const Wide exact = exact_value(t, x, 0);
    const bool fitting = -2048 <= exact && exact < 2048;
    left = left || !fitting;
    if (!fitting) continue;
    EXPECT_EQ(series.v(), static_cast<std::int64_t>(exact)) << "x = " << x;
    if (left) ++fitting_again;
  }
  EXPECT_GT(fitting_again, 5) << "the case never comes back into range";
}

RC_GTEST_PROP(FixedQuadratic, DifferenceIsThatOfNeighbours, ()) {
  const FixedQuadratic t = any_quadratic();
  const int x = *rc::gen::inRange(-4095, 4096), y = *rc::gen::inRange(-4095, 4096);
  RC_ASSERT(t.value(x, y) == low_bits(exact_value(t, x, y), 64));
  RC_ASSERT(wrap_add(t.value(x, y), t.difference(x, y)) == t.value(x + 1, y));
}

}  // namespace
}  // namespace phongpipe
