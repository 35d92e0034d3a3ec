// RTL forward_differencer ≡ model, at three widths, under random loads, steps and pauses.
#include "model/fixed/forward_differencer.h"

#include <gtest/gtest.h>

#include <random>

#include "Vforward_differencer_widths.h"

namespace phongpipe {
namespace {

class ForwardDifferencerRtl : public ::testing::Test {
 protected:
  void clock() {
    rtl_.clk = 0;
    rtl_.eval();
    rtl_.clk = 1;
    rtl_.eval();
  }
  void load(const SeriesStart& start) {
    rtl_.load = 1;
    rtl_.start_v = static_cast<std::uint64_t>(start.v);
    rtl_.start_d1 = static_cast<std::uint64_t>(start.d1);
    rtl_.start_d2 = static_cast<std::uint64_t>(start.d2);
    clock();
    rtl_.load = 0;
    for (ForwardDifferencer* model : {&narrow_, &usual_, &wide_}) model->load(start);
  }
  void step() {
    rtl_.step = 1;
    clock();
    rtl_.step = 0;
    for (ForwardDifferencer* model : {&narrow_, &usual_, &wide_}) model->step();
  }
  void expect_equal() const {
    ASSERT_EQ(wrap_to(rtl_.v9, 9), narrow_.v());
    ASSERT_EQ(wrap_to(rtl_.v26, 26), usual_.v());
    ASSERT_EQ(wrap_to(static_cast<std::int64_t>(rtl_.v40), 40), wide_.v());
  }

  Vforward_differencer_widths rtl_;
  ForwardDifferencer narrow_{9}, usual_{26}, wide_{40};
};

TEST_F(ForwardDifferencerRtl, LoadShowsTheStartInTheNextClock) {
  load({-3, 7, 2});
  expect_equal();
  EXPECT_EQ(wrap_to(rtl_.v9, 9), -3);
}

TEST_F(ForwardDifferencerRtl, TwoAdditionsAStep) {
  load({10, 5, -2});
  const std::int64_t expected[] = {15, 18, 19, 18, 15};
  for (const std::int64_t v : expected) {
    step();
    EXPECT_EQ(wrap_to(rtl_.v26, 26), v);
  }
}

TEST_F(ForwardDifferencerRtl, HoldsWithoutStep) {
  load({1, 2, 3});
  for (int i = 0; i < 5; ++i) clock();
  expect_equal();
}

TEST_F(ForwardDifferencerRtl, LoadWinsOverStep) {
  load({1, 2, 3});
  rtl_.step = 1;
  load({100, -1, 0});
  rtl_.step = 0;
  expect_equal();
  EXPECT_EQ(wrap_to(rtl_.v26, 26), 100);
}

TEST_F(ForwardDifferencerRtl, EqualsTheModelOnRandomSequences) {
  constexpr unsigned kSeed = 20;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 200'000; ++i) {
    const auto choice = random() % 16;
    if (choice == 0) {
      // Wild values: registers wrap all the time.
      load({static_cast<std::int64_t>(random()), static_cast<std::int64_t>(random()),
            static_cast<std::int64_t>(random())});
    } else if (choice < 13) {
      step();
    } else {
      clock();
    }
    expect_equal();
  }
}

}  // namespace
}  // namespace phongpipe
