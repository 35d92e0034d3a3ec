// RTL color_sum ≡ model for every width of ROM words.
#include "model/fixed/color_sum.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "Vcolor_sum_words.h"
#include "testbench/cases/format_range.h"

namespace phongpipe {
namespace {

constexpr int kDiffuseWidth = 14;

struct Inputs {
  std::int64_t diffuse, level;
  bool open;
  std::uint32_t word, increment;
};

// Clocks from diffuse and level to the clock in which the word is due, and to the sum.
constexpr std::size_t kWordDue = 5, kSumDue = 6;

class ColorSumRtl : public ::testing::Test {
 protected:
  void clock() {
    rtl_.clk = 0;
    rtl_.eval();
    rtl_.clk = 1;
    rtl_.eval();
  }
  void feed(const Inputs& inputs) {
    in_flight_.push_back(inputs);
    rtl_.diffuse = static_cast<SData>(inputs.diffuse) & 0x3fff;
    rtl_.level = static_cast<SData>(inputs.level) & 0x3fff;
    if (in_flight_.size() > kWordDue) {
      const Inputs& due = in_flight_[in_flight_.size() - 1 - kWordDue];
      rtl_.word = static_cast<SData>(due.word);
      rtl_.increment = static_cast<SData>(due.increment);
      rtl_.open = due.open;
    }
    clock();
    if (in_flight_.size() <= kSumDue) return;
    expect_color(in_flight_.front());
    in_flight_.pop_front();
  }
  void expect_color(const Inputs& in) const {
    for (int bits = kMinRomDataBits; bits <= kMaxRomDataBits; ++bits) {
      FrameConfiguration configuration;
      configuration.diffuse_fraction_bits = kDiffuseWidth - 10;
      configuration.rom_data_bits = bits;
      const auto word = static_cast<std::int32_t>((in.word + in.increment) & ((1U << bits) - 1));
      const std::int32_t clamped = clamped_diffuse(configuration, in.diffuse, in.level);
      const std::int32_t addend = in.open ? aligned_word(configuration, word) : 0;
      const auto show = [&] {
        return testing::Message() << bits << " bits, diffuse " << in.diffuse << ", level "
                                  << in.level << ", word " << word << ", open " << in.open;
      };
      const int place = bits - kMinRomDataBits;
      ASSERT_EQ(bits_of(rtl_.colors, 8 * place, 8), color_sum(configuration, clamped, addend))
          << show();
      ASSERT_EQ(bits_of(rtl_.sums, 10 * place, 10), light_sum(configuration, clamped, addend))
          << show();
    }
  }
  template <typename Port>
  static int bits_of(const Port& port, int first, int count) {
    int value = 0;
    for (int bit = first + count; bit-- > first;) {
      value = 2 * value + static_cast<int>(port[bit / 32] >> (bit % 32) & 1);
    }
    return value;
  }

  Vcolor_sum_words rtl_;
  std::deque<Inputs> in_flight_;
};

TEST_F(ColorSumRtl, EveryDiffuseValueAtTheExtremesOfTheOthers) {
  for (const std::int64_t level : {std::int64_t{0}, std::int64_t{8}, std::int64_t{4087}}) {
    for (const std::uint32_t word : {0U, 1U, 0xfffU}) {
      for (std::int64_t diffuse = -8192; diffuse < 8192; ++diffuse) {
        feed({diffuse, level, (diffuse & 1) != 0, word, 0});
      }
    }
  }
}

TEST_F(ColorSumRtl, RandomInputs) {
  constexpr unsigned kSeed = 21;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  for (int i = 0; i < 100'000; ++i) {
    feed({static_cast<std::int64_t>(random() % 16384) - 8192,
          static_cast<std::int64_t>(random() % 4096), random() % 2 == 0,
          static_cast<std::uint32_t>(random() & 0xfff),
          static_cast<std::uint32_t>(random() & 0xfff)});
  }
}

TEST_F(ColorSumRtl, LitOnlyAboveTheLevel) {
  rtl_.level = 100;
  for (const auto& [diffuse, lit] : {std::pair(99, 0), {100, 0}, {101, 1}, {0x2000, 0}}) {
    rtl_.diffuse = static_cast<SData>(diffuse);
    for (int i = 0; i < 3; ++i) clock();
    EXPECT_EQ(rtl_.lit, lit) << "diffuse " << diffuse;
  }
}

}  // namespace
}  // namespace phongpipe
