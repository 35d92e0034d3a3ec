// RTL forward_differencer ≡ model, at three widths, for spans of any length with pauses anywhere.
#include "model/fixed/forward_differencer.h"

#include <gtest/gtest.h>

#include <deque>
#include <optional>
#include <random>

#include "Vforward_differencer_widths.h"

namespace phongpipe {
namespace {

class ForwardDifferencerRtl : public ::testing::Test {
 protected:
  static constexpr std::size_t kLatency = 4;  // clocks after the one in which a pixel entered

  // The first pixel of a span enters.
  void load(const SeriesStart& start, bool stepping = true) {
    rtl_.load = 1;
    rtl_.stepping = stepping;
    rtl_.start_v = static_cast<std::uint64_t>(start.v);
    rtl_.start_d1 = static_cast<std::uint64_t>(start.d1);
    rtl_.start_d2 = static_cast<std::uint64_t>(start.d2);
    const SeriesStart kept = stepping ? start : SeriesStart{start.v, 0, 0};
    for (ForwardDifferencer* model : {&narrow_, &usual_, &wide_}) model->load(kept);
    enter();
    rtl_.load = 0;
    // What is on the ports between loads does not count.
    rtl_.start_v = rtl_.start_d1 = rtl_.start_d2 = 0x5555555555555555;
  }
  // The next pixel enters.
  void step() {
    for (ForwardDifferencer* model : {&narrow_, &usual_, &wide_}) model->step();
    enter();
  }
  void enter() {
    rtl_.enter = 1;
    clock(Values{narrow_.v(), usual_.v(), wide_.v()});
    rtl_.enter = 0;
  }
  void pause() { clock({}); }
  void finish() {
    for (std::size_t i = 0; i <= kLatency; ++i) pause();
  }

 private:
  struct Values {
    std::int64_t narrow, usual, wide;
  };
  void clock(const std::optional<Values>& entering) {
    rtl_.clk = 0;
    rtl_.eval();
    rtl_.clk = 1;
    rtl_.eval();
    in_flight_.push_back(entering);
    if (in_flight_.size() <= kLatency) return;
    if (const std::optional<Values>& due = in_flight_.front()) {
      ASSERT_EQ(wrap_to(rtl_.v9, 9), due->narrow);
      ASSERT_EQ(wrap_to(rtl_.v26, 26), due->usual);
      ASSERT_EQ(wrap_to(static_cast<std::int64_t>(rtl_.v40), 40), due->wide);
      ++compared_;
    }
    in_flight_.pop_front();
  }

  Vforward_differencer_widths rtl_;
  ForwardDifferencer narrow_{9}, usual_{26}, wide_{40};
  std::deque<std::optional<Values>> in_flight_;

 protected:
  int compared_ = 0;
};

TEST_F(ForwardDifferencerRtl, TwoAdditionsAPixel) {
  load({10, 5, -2});
  for (int i = 0; i < 20; ++i) step();
  finish();
  EXPECT_EQ(compared_, 21);
}

TEST_F(ForwardDifferencerRtl, SpansOfOnePixelFollowWithoutAPause) {
  for (std::int64_t i = 0; i < 10; ++i) load({100 * i, -7 * i, i});
  for (std::int64_t i = 0; i < 10; ++i) {
    load({100 * i, -7 * i, i});
    step();
  }
  finish();
  EXPECT_EQ(compared_, 30);
}

TEST_F(ForwardDifferencerRtl, ASeriesThatIsNotSteppedStaysAsItStarts) {
  load({1000, 7, 3}, false);
  for (int i = 0; i < 5; ++i) step();
  load({-5, 7, 3});
  for (int i = 0; i < 5; ++i) step();
  finish();
  EXPECT_EQ(compared_, 12);
}

TEST_F(ForwardDifferencerRtl, EqualsTheModelOnRandomSequences) {
  constexpr unsigned kSeed = 20;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  load({1, 2, 3});
  for (int i = 0; i < 200'000 && !HasFatalFailure(); ++i) {
    const auto choice = random() % 16;
    if (choice < 4) {
      // Wild values: registers wrap all the time.
      load({static_cast<std::int64_t>(random()), static_cast<std::int64_t>(random()),
            static_cast<std::int64_t>(random())},
           random() % 8 != 0);
    } else if (choice < 12) {
      step();
    } else {
      pause();
    }
  }
  EXPECT_GT(compared_, 100'000);
}

}  // namespace
}  // namespace phongpipe
