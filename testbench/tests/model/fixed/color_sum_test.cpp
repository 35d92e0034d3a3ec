// The end of the datapath, exhaustively: the bits it cuts off must never reach the output.
#include "model/fixed/color_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "testbench/cases/format_range.h"

namespace phongpipe {
namespace {

FrameConfiguration formats(int data_bits, int diffuse_fraction) {
  FrameConfiguration configuration;
  configuration.rom_data_bits = data_bits;
  configuration.diffuse_fraction_bits = diffuse_fraction;
  return configuration;
}

// min(255, ⌊max(diffuse, level) + word⌋), with 2^−40 output LSB as the unit and nothing cut off.
int exact_color(const FrameConfiguration& c, std::int64_t diffuse, std::int64_t level,
                std::int32_t word) {
  const std::int64_t series = std::max(diffuse, level) << (40 - c.diffuse_fraction_bits);
  const std::int64_t highlight = std::int64_t{word} << (40 + kOutputBits - c.rom_data_bits);
  return static_cast<int>(std::min<std::int64_t>((series + highlight) >> 40, kOutputMax));
}

int color_of(const FrameConfiguration& c, std::int64_t diffuse, std::int64_t level,
             std::int32_t word) {
  return color_sum(c, clamped_diffuse(c, diffuse, level), aligned_word(c, word));
}

// Every diffuse value of the register, with the words at the ends and in steps between.
void expect_exact(const FrameConfiguration& c, std::int64_t level, std::int32_t word_step) {
  const std::int64_t end = std::int64_t{1} << (c.diffuse_width() - 1);
  const std::int32_t last = (1 << c.rom_data_bits) - 1;
  for (std::int64_t diffuse = -end; diffuse < end; ++diffuse) {
    for (std::int32_t word = 0;; word = std::min(word + word_step, last)) {
      const int color = color_of(c, diffuse, level, word),
                exact = exact_color(c, diffuse, level, word);
      if (color != exact) {
        FAIL() << "diffuse " << diffuse << ", level " << level << ", word " << word << ": " << color
               << ", exactly " << exact << "; " << c.rom_data_bits << " data bits";
      }
      if (word == last) break;
    }
  }
}

TEST(ColorSum, IsExactForEveryDiffuseValueAndWordSize) {
  for (int data_bits = kMinRomDataBits; data_bits <= kMaxRomDataBits; ++data_bits) {
    const FrameConfiguration c = formats(data_bits, kMinDiffuseFraction);
    const std::int32_t words = 1 << data_bits;
    const std::int32_t step = std::max(1, words / 61);  // 61: prime, so that low bits vary
    expect_exact(c, 8, step);                           // the rounding half alone
    expect_exact(c, 25 * 16 + 13, step);
    expect_exact(c, 255 * 16 + 8, step);
  }
}

TEST(ColorSum, IsExactForEveryWordOfAByte) {
  expect_exact(formats(8, kMinDiffuseFraction), 8, 1);
}

TEST(ColorSum, SaturatesAndNeverWraps) {
  for (int data_bits = kMinRomDataBits; data_bits <= kMaxRomDataBits; ++data_bits) {
    for (const int fraction : {kMinDiffuseFraction, 16, kMaxDiffuseFraction}) {
      const FrameConfiguration c = formats(data_bits, fraction);
      const std::int64_t end = std::int64_t{1} << (c.diffuse_width() - 1);
      const std::int64_t half = std::int64_t{1} << (fraction - 1);
      const std::int32_t last = (1 << data_bits) - 1;
      EXPECT_EQ(color_of(c, end - 1, half, last), 255);
      EXPECT_EQ(color_of(c, end - 1, half, 0), 255);
      EXPECT_EQ(color_of(c, -end, half, 0), 0);
      EXPECT_EQ(color_of(c, std::int64_t{255} << fraction, half, last), 255);
      EXPECT_EQ(color_of(c, (std::int64_t{255} << fraction) - 1, half, 0), 254);
    }
  }
}

// With the half folded in, 12.5 LSB of ambient light and above show as 13.
TEST(ColorSum, ClampsAtTheLevelWhichIsRoundedToNearest) {
  const FrameConfiguration c = formats(8, 16);
  const auto ambient = [](double lsb) { return static_cast<std::int64_t>((lsb + 0.5) * 65536); };
  EXPECT_EQ(color_of(c, -1000000, ambient(12.49), 0), 12);
  EXPECT_EQ(color_of(c, -1000000, ambient(12.5), 0), 13);
  EXPECT_EQ(color_of(c, ambient(20), ambient(12.5), 0), 20);
}

TEST(ColorSum, IsLitAboveTheLevelOnly) {
  EXPECT_FALSE(is_lit(41, 42));
  EXPECT_FALSE(is_lit(42, 42)) << "N·L = 0 is unlit";
  EXPECT_TRUE(is_lit(43, 42));
  EXPECT_FALSE(is_lit(-43, 42));
}

TEST(ColorSum, WordsOfFewBitsAreAlignedToFullScale) {
  EXPECT_EQ(aligned_word(formats(4, 16), 15), 240);
  EXPECT_EQ(aligned_word(formats(8, 16), 255), 255);
  EXPECT_EQ(aligned_word(formats(12, 16), 4095), 4095);
  EXPECT_EQ(formats(12, 16).sum_fraction_bits(), 4);
  EXPECT_EQ(formats(4, 16).sum_fraction_bits(), 0);
}

}  // namespace
}  // namespace phongpipe
