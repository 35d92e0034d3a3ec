// The SystemC side of pixel_datapath by the clock: exact latency, one pixel a clock, stalls, reset.
#include "sim/datapath_registers.h"

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "model/fixed/pixel_datapath.h"
#include "sim/datapath_driver.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kDatapathRegistersSeed = 43;

class DatapathRegistersTest : public testing::Test {
 protected:
  DatapathRegistersTest()
      : random_(kDatapathRegistersSeed), pipeline_(configuration_), values_(configuration_) {
    table_.roms.emplace_back(configuration_, 0.5, 20);
    values_.load_table(table_);
    for (int i = 0; i < configuration_.rom_words(); ++i) clock(nullptr, false, i);
  }

  DatapathOutputs clock(const Span* span, bool pixel_ready, int rom_address = -1) {
    DatapathInputs inputs;
    inputs.span = span;
    inputs.pixel_ready = pixel_ready;
    if (rom_address >= 0) {
      inputs.table = &table_;
      inputs.rom_address = rom_address;
    }
    return pipeline_.clock(inputs);
  }

  Span make_span(int length) {
    Span span;
    span.row = {random_.integer(0, 4000), random_.integer(0, 4095), length};
    span.level[0] = 1 << 15;
    span.diffuse[0] = {random_.integer(0, 1 << 24), random_.integer(-1000, 1000), 3};
    span.specular = {random_.integer(0, 1 << 22), random_.integer(-1000, 1000), 3};
    return span;
  }
  // What the span's pixels must be.
  std::vector<ShadedPixel> pixels_of(const Span& span) const {
    std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length));
    values_.shade(span, colors.data());
    std::vector<ShadedPixel> pixels;
    for (int i = 0; i < span.row.length; ++i) {
      pixels.push_back({static_cast<std::uint16_t>(span.row.x + i),
                        static_cast<std::uint16_t>(span.row.y),
                        colors[static_cast<std::size_t>(i)]});
    }
    return pixels;
  }

  Random random_;
  FrameConfiguration configuration_;
  HighlightTable table_;
  DatapathRegisters pipeline_;
  PixelDatapath values_;
};

TEST_F(DatapathRegistersTest, TheFirstPixelTakesExactlyTheLatency) {
  const Span span = make_span(1);
  ASSERT_TRUE(clock(&span, true).span_ready);
  for (int i = 1; i < kDatapathLatency; ++i) {
    EXPECT_FALSE(clock(nullptr, true).pixel_valid) << i << " clocks after the span was taken";
  }
  const DatapathOutputs outputs = clock(nullptr, true);
  EXPECT_TRUE(outputs.pixel_valid);
  EXPECT_EQ(outputs.pixel, pixels_of(span)[0]);
  EXPECT_FALSE(clock(nullptr, true).pixel_valid);
}

TEST_F(DatapathRegistersTest, OnePixelAClockWithoutBubblesBetweenSpans) {
  std::deque<Span> spans;
  std::vector<ShadedPixel> expected;
  for (const int length : {1, 5, 1, 1, 17, 2, 64}) {
    spans.push_back(make_span(length));
    for (const ShadedPixel& pixel : pixels_of(spans.back())) expected.push_back(pixel);
  }
  std::vector<ShadedPixel> stream;
  for (std::size_t cycle = 0; stream.size() < expected.size(); ++cycle) {
    const DatapathOutputs outputs = clock(spans.empty() ? nullptr : &spans.front(), true);
    if (!spans.empty() && outputs.span_ready) spans.pop_front();
    ASSERT_EQ(outputs.pixel_valid, cycle >= kDatapathLatency) << "clock " << cycle;
    if (outputs.pixel_valid) stream.push_back(outputs.pixel);
  }
  EXPECT_TRUE(stream == expected);
}

TEST_F(DatapathRegistersTest, AStallHoldsTheOutputUntilItIsTaken) {
  const Span span = make_span(20);
  const std::vector<ShadedPixel> expected = pixels_of(span);
  ASSERT_TRUE(clock(&span, false).span_ready);
  for (int i = 1; i < kDatapathLatency; ++i) clock(nullptr, false);
  std::size_t taken = 0;
  for (int cycle = 0; taken < expected.size(); ++cycle) {
    ASSERT_LT(cycle, 1000) << "nothing comes out any more";
    const bool ready = random_.integer(0, 2) == 0;
    const DatapathOutputs outputs = clock(nullptr, ready);
    ASSERT_TRUE(outputs.pixel_valid);
    ASSERT_EQ(outputs.pixel, expected[taken]) << "pixel " << taken;
    if (ready) ++taken;
  }
}

TEST_F(DatapathRegistersTest, StalledItFillsTheQueueAndTheOutput) {
  std::vector<Span> spans;
  for (int i = 0; i < 100; ++i) spans.push_back(make_span(1));
  std::size_t taken = 0;
  for (int cycle = 0; cycle < 100; ++cycle) {
    if (clock(&spans[taken], false).span_ready) ++taken;
  }
  EXPECT_EQ(taken, static_cast<std::size_t>(kPixelQueueSlots + 1));
}

// The stall's bubbles are closed before it reaches the input.
TEST_F(DatapathRegistersTest, AStallClosesBubbles) {
  const Span first = make_span(1), second = make_span(1);
  ASSERT_TRUE(clock(&first, false).span_ready);
  for (int i = 0; i < 20; ++i) clock(nullptr, false);  // the first waits at the output
  ASSERT_TRUE(clock(&second, false).span_ready);
  for (int i = 0; i < 20; ++i) clock(nullptr, false);
  EXPECT_EQ(clock(nullptr, true).pixel, pixels_of(first)[0]);
  const DatapathOutputs outputs = clock(nullptr, true);
  EXPECT_TRUE(outputs.pixel_valid) << "the second stands right behind it";
  EXPECT_EQ(outputs.pixel, pixels_of(second)[0]);
}

TEST_F(DatapathRegistersTest, ResetInMidRunDropsPixelsAndKeepsTheTable) {
  for (int clocks = 0; clocks < 24; ++clocks) {
    const Span dropped = make_span(8), span = make_span(3);
    clock(&dropped, true);
    for (int i = 0; i < clocks; ++i) clock(nullptr, i % 3 != 0);
    pipeline_.reset();
    std::vector<ShadedPixel> stream;
    ASSERT_TRUE(clock(&span, true).span_ready) << "reset after " << clocks << " clocks";
    for (int i = 0; i < 20; ++i) {
      const DatapathOutputs outputs = clock(nullptr, true);
      if (outputs.pixel_valid) stream.push_back(outputs.pixel);
    }
    EXPECT_TRUE(stream == pixels_of(span)) << "reset after " << clocks << " clocks";
  }
}

TEST(DatapathDriver, LoadsATableOnlyWhenEmptyAndOneWordAClock) {
  Random random(kDatapathRegistersSeed);
  const Scene scene = lit_scene(64, 64);
  FrameConfiguration configuration;
  configuration.rom_address_bits = 6;
  const FrameSetup frame(scene, random_geometry(random, scene, 1, 20), configuration);
  DatapathRegisters pipeline(configuration);
  DatapathDriver driver(frame, pipeline);
  std::vector<Span> spans(3);
  const std::vector<std::uint32_t> tables = {1, 1, 0};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].row = {0, static_cast<int>(i), 10};
    spans[i].table = tables[i];
  }
  int loading = 0, pixels = 0;
  std::vector<int> loaded_before;  // words, before each span
  for (int cycle = 0; cycle < 300; ++cycle) {
    const std::size_t next = loaded_before.size();
    const DatapathDriver::Outcome outcome =
        driver.clock(next < spans.size() ? &spans[next] : nullptr, true);
    if (outcome.loading) {
      ++loading;
      EXPECT_EQ(pixels, next == 0 ? 0 : 20) << "a word was written while pixels were in flight";
    }
    if (outcome.span_taken) loaded_before.push_back(loading);
    if (outcome.pixel_taken) ++pixels;
  }
  EXPECT_EQ(loaded_before, (std::vector<int>{64, 64, 128}));
  EXPECT_EQ(pixels, 30);
  EXPECT_EQ(driver.pixels_in_flight(), 0);
  // 20 pixels, then 10, each with the clocks from the first span's acceptance to the last pixel.
  EXPECT_EQ(driver.busy_clocks(), 20 + 10 + 2 * kDatapathLatency);
}

}  // namespace
}  // namespace phongpipe
