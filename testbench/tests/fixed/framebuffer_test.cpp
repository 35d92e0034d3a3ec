// framebuffer: the nearer pixel wins, the earlier one where depths are equal.
#include "model/fixed/framebuffer.h"

#include <gtest/gtest.h>

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
  ASSERT_EQ(color.colors().size(), 12U);
  EXPECT_EQ(color.width(), 4);
  EXPECT_EQ(color.height(), 3);
  for (const std::uint32_t pixel : color.colors()) EXPECT_EQ(pixel, 0xff8033U);  // 51, 128, 255
  for (const std::uint32_t pixel : grey.colors()) EXPECT_EQ(pixel, 0x33U);
  for (const std::uint32_t place : color.places()) EXPECT_EQ(place, Framebuffer::kNoPixel);
}

TEST(Framebuffer, TheNearerPixelWins) {
  Framebuffer framebuffer(small_frame());
  const std::size_t index = 2 * 4 + 3;
  EXPECT_TRUE(framebuffer.write({3, 2, 10}, 100, 0));
  EXPECT_FALSE(framebuffer.write({3, 2, 20}, 101, 1));
  EXPECT_EQ(framebuffer.colors()[index], 10U);
  EXPECT_TRUE(framebuffer.write({3, 2, 30}, 99, 2));
  EXPECT_EQ(framebuffer.colors()[index], 30U);
  EXPECT_EQ(framebuffer.places()[index], 2U);
}

TEST(Framebuffer, TheEarlierPixelWinsWhereDepthsAreEqual) {
  Framebuffer framebuffer(small_frame());
  EXPECT_TRUE(framebuffer.write({0, 0, 10}, 0, 0));
  EXPECT_FALSE(framebuffer.write({0, 0, 20}, 0, 1));
  EXPECT_EQ(framebuffer.colors()[0], 10U);
  EXPECT_EQ(framebuffer.places()[0], 0U);
}

TEST(Framebuffer, WritesOnePixelAndTheFarthestDepthBeatsTheBackground) {
  const FrameSetup frame = small_frame(3, 30);
  Framebuffer framebuffer(frame);
  EXPECT_TRUE(framebuffer.write({1, 2, 0x123456}, (1U << 30) - 1, 7));
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(framebuffer.colors()[i], i == 9 ? 0x123456U : 0xff8033U) << "index " << i;
    EXPECT_EQ(framebuffer.places()[i], i == 9 ? 7U : Framebuffer::kNoPixel) << "index " << i;
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
