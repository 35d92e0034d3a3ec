// framebuffer: the nearer pixel wins, the earlier one where depths are equal, and further lights
// are added to the pixels of the triangle that won.
#include "model/fixed/framebuffer.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

// One triangle, which reaches to every pixel.
const Geometry& whole_image() {
  static const Geometry geometry = [] {
    Geometry result;
    result.materials = {grey_material(0.6, 0.3, 20)};
    ScreenTriangle triangle;
    triangle.vertices[1].x = triangle.vertices[2].y = snap(8);
    result.triangles = {triangle};
    return result;
  }();
  return geometry;
}

FrameSetup small_frame(int channels = 3, int depth_bits = 8, std::size_t lights = 1,
                       Effects effects = Effects::derived) {
  Scene scene = lit_scene(4, 3);
  scene.image.background = Color(0.2, 0.5, 1);
  scene.lights.resize(lights);
  FrameConfiguration configuration;
  configuration.channels = channels;
  configuration.depth_bits = depth_bits;
  return FrameSetup(scene, whole_image(), configuration, effects);
}

// The image has 4 × 3 pixels, of which a triangle reaches to 2 × 2.
TEST(Framebuffer, HasCellsWhereTrianglesReachAndBackgroundElsewhere) {
  Scene scene = lit_scene(4, 3);
  scene.image.background = Color(0.2, 0.5, 1);
  Geometry geometry = whole_image();
  std::array<ScreenVertex, 3>& v = geometry.triangles.front().vertices;
  v[0].x = v[1].x = snap(1.5);
  v[2].x = snap(2.25);
  v[0].y = v[2].y = snap(1.0);
  v[1].y = snap(9.0);
  Framebuffer framebuffer(FrameSetup(scene, geometry, FrameConfiguration()),
                          Framebuffer::Owners::kept);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      const bool reached = x >= 1 && x <= 2 && y >= 1;
      EXPECT_EQ(framebuffer.contains(x, y), reached) << x << ", " << y;
      EXPECT_FALSE(framebuffer.covered(framebuffer.index_of(x, y)));
      EXPECT_FALSE(framebuffer.owned(framebuffer.index_of(x, y), 0));
    }
  }
  EXPECT_TRUE(framebuffer.write(2, 1, 5, 0, 7));
  EXPECT_TRUE(framebuffer.write(1, 2, 5, 0, 8));
  std::vector<std::size_t> covered;
  framebuffer.for_each_covered([&](std::size_t index, std::uint32_t) { covered.push_back(index); });
  EXPECT_EQ(covered, (std::vector<std::size_t>{1 * 4 + 2, 2 * 4 + 1}));
  EXPECT_EQ(framebuffer.color(1 * 4 + 2), 7U);
  EXPECT_EQ(framebuffer.owner(1 * 4 + 2), 0U);
}

TEST(Framebuffer, StartsAsBackground) {
  const Framebuffer color(small_frame(3)), grey(small_frame(1));
  ASSERT_EQ(color.size(), 12U);
  for (std::size_t i = 0; i < color.size(); ++i) {
    EXPECT_FALSE(color.covered(i));
    EXPECT_EQ(color.color(i), 0xff8033U);  // 51, 128, 255
    EXPECT_EQ(grey.color(i), 0x33U);
  }
}

TEST(Framebuffer, TheNearerPixelWins) {
  Framebuffer framebuffer(small_frame());
  const std::size_t index = 2 * 4 + 3;
  EXPECT_TRUE(framebuffer.write(3, 2, 100, 0, 10));
  EXPECT_FALSE(framebuffer.write(3, 2, 101, 1, 20));
  EXPECT_EQ(framebuffer.color(index), 10U);
  EXPECT_TRUE(framebuffer.write(3, 2, 99, 2, 30));
  EXPECT_EQ(framebuffer.color(index), 30U);
}

TEST(Framebuffer, TheEarlierPixelWinsWhereDepthsAreEqual) {
  Framebuffer framebuffer(small_frame());
  EXPECT_TRUE(framebuffer.write(0, 0, 0, 0, 10));
  EXPECT_FALSE(framebuffer.write(0, 0, 0, 1, 20));
  EXPECT_EQ(framebuffer.color(0), 10U);
}

TEST(Framebuffer, WritesOnePixelAndTheFarthestDepthBeatsTheBackground) {
  Framebuffer framebuffer(small_frame(3, 30));
  EXPECT_TRUE(framebuffer.write(1, 2, (1U << 30) - 1, 0, 0));
  for (std::size_t i = 0; i < framebuffer.size(); ++i) {
    EXPECT_EQ(framebuffer.covered(i), i == 9) << "index " << i;
    EXPECT_EQ(framebuffer.color(i), i == 9 ? 0U : 0xff8033U) << "index " << i;
  }
}

// `depth_test`: whether some pixel may be covered twice.
Framebuffer under_two_lights(bool depth_test) {
  return Framebuffer(small_frame(3, 8, 2, depth_test ? Effects::all : Effects::derived));
}

TEST(Framebuffer, AFurtherLightIsAddedAndSaturatesEachChannelAlone) {
  for (const bool depth_test : {false, true}) {
    Framebuffer framebuffer = under_two_lights(depth_test);
    framebuffer.write(1, 1, 0, 0, 0x10fe80);
    EXPECT_TRUE(framebuffer.add(1, 1, 0, 0x200180));
    EXPECT_EQ(framebuffer.color(5), 0x30ffffU) << "no carry into the next channel";
    EXPECT_TRUE(framebuffer.add(1, 1, 0, 0xff0201));
    EXPECT_EQ(framebuffer.color(5), 0xffffffU);
    EXPECT_TRUE(framebuffer.add(1, 1, 0, 0));
    EXPECT_EQ(framebuffer.color(5), 0xffffffU);
  }
}

TEST(Framebuffer, AFurtherLightIsAddedOnlyWhereItsTriangleIsSeen) {
  Framebuffer framebuffer = under_two_lights(true);
  framebuffer.write(2, 0, 100, 0, 10);
  framebuffer.write(2, 0, 50, 1, 20);  // hides it
  framebuffer.write(3, 0, 100, 0, 10);
  EXPECT_FALSE(framebuffer.add(2, 0, 0, 5));
  EXPECT_TRUE(framebuffer.add(2, 0, 1, 6));
  EXPECT_TRUE(framebuffer.add(3, 0, 0, 5));
  EXPECT_FALSE(framebuffer.add(3, 0, 1, 6));
  EXPECT_EQ(framebuffer.color(2), 26U);
  EXPECT_EQ(framebuffer.color(3), 15U);
}

// A comparison of depths could not tell the two apart.
TEST(Framebuffer, OfTwoTrianglesAtTheSameDepthOnlyTheEarliersLightsAreAdded) {
  Framebuffer framebuffer = under_two_lights(true);
  EXPECT_TRUE(framebuffer.write(0, 2, 77, 4, 10));
  EXPECT_FALSE(framebuffer.write(0, 2, 77, 5, 20));
  EXPECT_TRUE(framebuffer.add(0, 2, 4, 1));
  EXPECT_FALSE(framebuffer.add(0, 2, 5, 2));
  EXPECT_EQ(framebuffer.color(8), 11U);
}

// No pixel is covered twice, so that nobody needs to ask whose it is.
TEST(Framebuffer, WithoutADepthTestEveryFurtherLightIsAdded) {
  Framebuffer framebuffer = under_two_lights(false);
  EXPECT_TRUE(framebuffer.write(0, 0, 0, 0, 10));
  EXPECT_TRUE(framebuffer.write(1, 0, 0, 1, 20));
  EXPECT_TRUE(framebuffer.add(0, 0, 0, 3));
  EXPECT_TRUE(framebuffer.add(1, 0, 1, 4));
  EXPECT_EQ(framebuffer.color(0), 13U);
  EXPECT_EQ(framebuffer.color(1), 24U);
}

TEST(Framebuffer, TellsWhoseAPixelIsWhereOwnersAreKept) {
  Framebuffer framebuffer(small_frame(), Framebuffer::Owners::kept);
  framebuffer.write(1, 0, 9, 3, 10);
  EXPECT_TRUE(framebuffer.owned(1, 3));
  EXPECT_FALSE(framebuffer.owned(1, 2));
  framebuffer.write(1, 0, 8, 2, 20);
  EXPECT_TRUE(framebuffer.owned(1, 2));
  EXPECT_FALSE(framebuffer.owned(0, 0)) << "nothing is there";
}

TEST(Framebuffer, ASpanIsWrittenAsItsPixelsAre) {
  constexpr unsigned kSeed = 23;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  const FrameSetup frame = small_frame(1, 8);
  using Owners = Framebuffer::Owners;
  Framebuffer by_span(frame, Owners::kept), by_pixel(frame, Owners::kept);
  for (int k = 0; k < 200; ++k) {
    Span span;
    span.row.x = random.integer(0, 3);
    span.row.y = random.integer(0, 2);
    span.row.length = random.integer(1, 4 - span.row.x);
    span.triangle = static_cast<std::uint32_t>(random.integer(0, 5));
    span.first_pass = random.integer(0, 3) > 0;
    span.depth = random.integer(-10, 265) * (std::int64_t{1} << kDepthFraction);
    span.depth_step = random.integer(-(3 << kDepthFraction), 3 << kDepthFraction);
    const std::array<std::uint32_t, 4> values = {1, 2, 3, 4};
    std::array<std::uint8_t, 4> written = {};
    by_span.take_span(frame, span, values.data(), written.data());
    for (int i = 0; i < span.row.length; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int x = span.row.x + i, y = span.row.y;
      EXPECT_EQ(written[at] != 0, span.first_pass
                                      ? by_pixel.write(x, y, Framebuffer::depth(frame, span, i),
                                                       span.triangle, values[at])
                                      : by_pixel.add(x, y, span.triangle, values[at]))
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
