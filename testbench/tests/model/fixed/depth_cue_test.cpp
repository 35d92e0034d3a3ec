// depth_cue: both ends of the fade are exact, what lies between is rounded to nearest, and no pixel
// leaves the range between its own colour and the colour of depth cueing.
#include "model/fixed/depth_cue.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace phongpipe {
namespace {

constexpr std::int32_t kWholeFactor = 1 << kCueFactorBits;
// The largest sum of a series with its guard bit and a word.
constexpr std::int32_t kLargestSum = (1 << (kGuardBits + kOutputBits)) - 1 + kOutputMax;
constexpr std::int32_t kCues[] = {0, 1, 17, 127, 128, 254, 255};

// sum·f + cue·(1 − f), exactly, in units of 1/kWholeFactor; then to nearest, halves up.
std::int32_t exact(std::int32_t sum, std::int32_t cue, std::int32_t factor) {
  const std::int32_t mixture = sum * factor + cue * (kWholeFactor - factor);
  return std::min((2 * mixture + kWholeFactor) / (2 * kWholeFactor), kOutputMax);
}

TEST(DepthCue, WithoutAShareOfItsOwnAPixelHasTheCuesColor) {
  for (std::int32_t cue = 0; cue <= kOutputMax; ++cue) {
    for (std::int32_t sum = 0; sum <= kLargestSum; ++sum) ASSERT_EQ(depth_cue(sum, cue, 0), cue);
  }
}

TEST(DepthCue, WithAllOfItsOwnAPixelIsAsWithoutDepthCueing) {
  for (std::int32_t cue = 0; cue <= kOutputMax; ++cue) {
    for (std::int32_t sum = 0; sum <= kLargestSum; ++sum) {
      ASSERT_EQ(depth_cue(sum, cue, kWholeFactor), std::min(sum, kOutputMax));
    }
  }
}

TEST(DepthCue, IsRoundedExactlyAndStaysBetweenSumAndCue) {
  for (const std::int32_t cue : kCues) {
    for (std::int32_t sum = 0; sum <= kLargestSum; ++sum) {
      const std::int32_t own = std::min(sum, kOutputMax);
      for (std::int32_t factor = 0; factor <= kWholeFactor; ++factor) {
        const std::int32_t color = depth_cue(sum, cue, factor);
        if (color != exact(sum, cue, factor) || color < std::min(own, cue) ||
            color > std::max(own, cue)) {
          FAIL() << "sum " << sum << ", cue " << cue << ", factor " << factor << ": " << color
                 << ", exactly " << exact(sum, cue, factor);
        }
      }
    }
  }
}

// 510 LSB half faded to black is full scale still: overexposure counts before it is cut off.
TEST(DepthCue, AnOverexposedPixelFadesFromItsUnclampedValue) {
  EXPECT_EQ(depth_cue(510, 0, kWholeFactor / 2), 255);
  EXPECT_EQ(depth_cue(510, 0, kWholeFactor / 4), 128);
  EXPECT_EQ(depth_cue(510, 100, kWholeFactor / 4), 203);  // 100 + 410/4 = 202.5
}

TEST(DepthCue, TheFactorIsTheSeriesClampedAndCutOff) {
  constexpr std::int64_t kOne = std::int64_t{1} << kCueFraction, kLsb = kOne / kWholeFactor;
  constexpr std::int64_t kEnd = std::int64_t{1} << (kCueWidth - 1);
  EXPECT_EQ(cue_factor(-kEnd), 0);
  EXPECT_EQ(cue_factor(-1), 0);
  EXPECT_EQ(cue_factor(0), 0);
  EXPECT_EQ(cue_factor(kLsb - 1), 0);
  EXPECT_EQ(cue_factor(kLsb), 1);
  EXPECT_EQ(cue_factor(kOne / 2), kWholeFactor / 2);
  EXPECT_EQ(cue_factor(kOne - 1), kWholeFactor - 1);
  EXPECT_EQ(cue_factor(kOne), kWholeFactor);
  EXPECT_EQ(cue_factor(kEnd - 1), kWholeFactor);
}

}  // namespace
}  // namespace phongpipe
