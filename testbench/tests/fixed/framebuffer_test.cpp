// framebuffer: the nearer pixel wins, the earlier one where depths are equal.
#include "model/fixed/framebuffer.h"

#include <gtest/gtest.h>

#include <array>

#include "testbench/tests/fixed/random_frame.h"

namespace phongpipe {
namespace {

FrameSetup small_frame(int channels = 3, int depth_bits = 8) {
  Scene scene = lit_scene(4, 3);
  scene.image.background = Color(0.2, 0.5, 1);
  DatapathConfiguration configuration;
  configuration.channels = channels;
  return FrameSetup(scene, Geometry(), configuration, depth_bits);
}

TEST(Framebuffer, StartsAsBackground) {
  const Framebuffer color(small_frame(3)), grey(small_frame(1));
  ASSERT_EQ(color.size(), 12U);
  EXPECT_EQ(color.background(), 0xff8033U);  // 51, 128, 255
  EXPECT_EQ(grey.background(), 0x33U);
  for (std::size_t i = 0; i < color.size(); ++i) {
    EXPECT_FALSE(color.covered(i));
    EXPECT_EQ(color.color(i), 0xff8033U);
    EXPECT_EQ(grey.color(i), 0x33U);
  }
}

TEST(Framebuffer, TheNearerPixelWins) {
  Framebuffer framebuffer(small_frame());
  const std::size_t index = 2 * 4 + 3;
  EXPECT_TRUE(framebuffer.write(3, 2, 100, 10));
  EXPECT_FALSE(framebuffer.write(3, 2, 101, 20));
  EXPECT_EQ(framebuffer.value(index), 10U);
  EXPECT_TRUE(framebuffer.write(3, 2, 99, 30));
  EXPECT_EQ(framebuffer.value(index), 30U);
}

TEST(Framebuffer, TheEarlierPixelWinsWhereDepthsAreEqual) {
  Framebuffer framebuffer(small_frame());
  EXPECT_TRUE(framebuffer.write(0, 0, 0, 10));
  EXPECT_FALSE(framebuffer.write(0, 0, 0, 20));
  EXPECT_EQ(framebuffer.value(0), 10U);
}

TEST(Framebuffer, WritesOnePixelAndTheFarthestDepthBeatsTheBackground) {
  Framebuffer framebuffer(small_frame(3, 30));
  EXPECT_TRUE(framebuffer.write(1, 2, (1U << 30) - 1, 0));
  for (std::size_t i = 0; i < framebuffer.size(); ++i) {
    EXPECT_EQ(framebuffer.covered(i), i == 9) << "index " << i;
    EXPECT_EQ(framebuffer.color(i), i == 9 ? 0U : 0xff8033U) << "index " << i;
  }
}

TEST(Framebuffer, ASpanIsWrittenAsItsPixelsAre) {
  constexpr unsigned kSeed = 23;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  const FrameSetup frame = small_frame(1, 8);
  Framebuffer by_span(frame), by_pixel(frame);
  for (int k = 0; k < 200; ++k) {
    Span span;
    span.row.x = random.integer(0, 3);
    span.row.y = random.integer(0, 2);
    span.row.length = random.integer(1, 4 - span.row.x);
    span.depth = random.integer(-10, 265) * (std::int64_t{1} << kDepthFraction);
    span.depth_step = random.integer(-(3 << kDepthFraction), 3 << kDepthFraction);
    const std::array<std::uint32_t, 4> values = {1, 2, 3, 4};
    std::array<std::uint8_t, 4> written = {};
    by_span.write_span(frame, span, values.data(), written.data());
    for (int i = 0; i < span.row.length; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_EQ(written[at] != 0, by_pixel.write(span.row.x + i, span.row.y,
                                                 Framebuffer::depth(frame, span, i), values[at]))
          << "span " << k << ", pixel " << i;
    }
    for (std::size_t i = 0; i < by_span.size(); ++i) {
      ASSERT_EQ(by_span.color(i), by_pixel.color(i)) << "span " << k << ", index " << i;
    }
  }
}

TEST(Framebuffer, DepthIsSteppedCutOffAndSaturates) {
  const FrameSetup frame = small_frame(1, 8);
  const std::int64_t one = std::int64_t{1} << kDepthFraction;
  Span span;
  span.depth = 10 * one + one - 1;
  span.depth_step = one / 2;
  EXPECT_EQ(Framebuffer::depth(frame, span, 0), 10U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 1), 11U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 2), 11U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 3), 12U);
  span.depth_step = -one;
  EXPECT_EQ(Framebuffer::depth(frame, span, 10), 0U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 11), 0U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 4000), 0U);
  span.depth_step = 100 * one;
  EXPECT_EQ(Framebuffer::depth(frame, span, 2), 210U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 3), 255U);
  EXPECT_EQ(Framebuffer::depth(frame, span, 4000), 255U);
}

}  // namespace
}  // namespace phongpipe
