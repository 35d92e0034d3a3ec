// The datapath's parameters: both ends of every range are legal, what lies beyond is refused by key
// and range, and the formats follow.
#include "model/fixed/datapath_configuration.h"

#include <gtest/gtest.h>

#include <string>

#include "model/scene/input_error.h"
#include "testbench/cases/format_range.h"

namespace phongpipe {
namespace {

std::string refusal(const DatapathConfiguration& configuration) {
  try {
    configuration.check();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Range {
  const char* key;
  int DatapathConfiguration::*value;
  int low, high;
};

class DatapathRange : public testing::TestWithParam<Range> {};

TEST_P(DatapathRange, IsHeldAtBothEnds) {
  const auto& [key, value, low, high] = GetParam();
  DatapathConfiguration configuration;
  for (const int legal : {low, high}) {
    configuration.*value = legal;
    EXPECT_EQ(refusal(configuration), "no error") << key << " = " << legal;
  }
  for (const int illegal : {low - 1, high + 1, -1000}) {
    configuration.*value = illegal;
    const std::string message = refusal(configuration);
    const std::string what = "datapath." + std::string(key) + " = " + std::to_string(illegal);
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(low) + " to " + std::to_string(high)), std::string::npos)
        << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    DatapathConfiguration, DatapathRange,
    testing::Values(
        Range{"diffuse_fraction_bits", &DatapathConfiguration::diffuse_fraction_bits, 4, 30},
        Range{"specular_fraction_bits", &DatapathConfiguration::specular_fraction_bits, 1, 25},
        Range{"rom_address_bits", &DatapathConfiguration::rom_address_bits, 6, 13},
        Range{"rom_data_bits", &DatapathConfiguration::rom_data_bits, 4, 12}),
    [](const auto& range) { return std::string(range.param.key); });

TEST(DatapathConfiguration, HasOneOrThreeChannels) {
  DatapathConfiguration configuration;
  for (const int channels : {1, 3}) {
    configuration.channels = channels;
    EXPECT_EQ(refusal(configuration), "no error");
  }
  for (const int channels : {0, 2, 4}) {
    configuration.channels = channels;
    EXPECT_EQ(refusal(configuration),
              "datapath.channels = " + std::to_string(channels) + ": 1 (grey) or 3 (colour)");
  }
}

TEST(DatapathConfiguration, FormatsFollow) {
  DatapathConfiguration c;
  c.diffuse_fraction_bits = 16;
  c.specular_fraction_bits = 12;
  c.rom_address_bits = 10;
  EXPECT_EQ(c.diffuse_width(), 26);   // sign, guard, 8, 16
  EXPECT_EQ(c.specular_width(), 24);  // sign, guard, 10, 12
  EXPECT_EQ(c.rom_words(), 1024);
  c.diffuse_fraction_bits = kMaxDiffuseFraction;
  c.specular_fraction_bits = kMaxSpecularFraction;
  c.rom_address_bits = kMaxRomAddressBits;
  EXPECT_EQ(c.diffuse_width(), 40);
  EXPECT_EQ(c.specular_width(), 40);
}

TEST(DatapathConfiguration, AHighlightWithoutDiffuseLightNeedsAnotherGate) {
  DatapathConfiguration configuration;
  configuration.diffuse = false;
  configuration.gate = GateSource::diffuse;
  EXPECT_NE(refusal(configuration).find("specular_gate = \"diffuse\" needs a diffuse series"),
            std::string::npos);
  for (const GateSource gate : {GateSource::off, GateSource::series}) {
    configuration.gate = gate;
    EXPECT_EQ(refusal(configuration), "no error");
  }
  configuration.gate = GateSource::diffuse;
  configuration.specular = false;
  EXPECT_EQ(refusal(configuration), "no error") << "nothing is gated";
}

TEST(DatapathConfiguration, BlocksLeftOutCostNothing) {
  DatapathConfiguration c;
  c.channels = 3;
  c.gate = GateSource::series;
  c.specular = false;
  EXPECT_EQ(c.series(), 3) << "no highlight, no gate";
  EXPECT_EQ(c.adders(), 6);
  EXPECT_EQ(c.rom_bits(), 0);
  c.diffuse = false;
  EXPECT_EQ(c.series(), 0);
  EXPECT_EQ(c.adders(), 0);
  EXPECT_EQ(c.multipliers(), 0);
  EXPECT_EQ(c.latency_cycles(), kDatapathLatency);
  c.depth_cue = true;
  EXPECT_EQ(c.adders(), 7) << "a linear series, a difference and a sum a channel";
  EXPECT_EQ(c.multipliers(), 3);
  EXPECT_EQ(c.latency_cycles(), kDatapathLatency + kDepthCueLatency);
  c.specular = true;
  EXPECT_EQ(c.series(), 2) << "N·H and the gate";
  EXPECT_EQ(c.adders(), 4 + 3 + 7);
  EXPECT_EQ(c.rom_bits(), 3 * 8 * 1024);
}

TEST(DatapathConfiguration, KindsDifferInTimeAndSize) {
  DatapathConfiguration c;
  EXPECT_EQ(c.interval_cycles(), 1);
  EXPECT_EQ(c.adders(), 5);
  c.kind = DatapathKind::serial;
  EXPECT_EQ(c.serial_digits(), 4) << "26 and 24 bits";
  EXPECT_EQ(c.interval_cycles(), 2 * 4);
  EXPECT_EQ(c.latency_cycles(), kDatapathLatency - kSerialStages + 8);
  EXPECT_EQ(c.adders(), 3) << "v and its difference, and the sum";
  c.diffuse_fraction_bits = c.specular_fraction_bits = 4;
  EXPECT_EQ(c.interval_cycles(), 2 * kLeastDigits);
  c.depth_cue = true;
  EXPECT_EQ(c.interval_cycles(), 3 * 4) << "32 bits of depth cueing";
  c = {};
  c.kind = DatapathKind::wide4;
  EXPECT_EQ(c.lanes(), 4);
  EXPECT_EQ(c.interval_cycles(), 1);
  EXPECT_EQ(c.latency_cycles(), kDatapathLatency + kLaneStages);
  EXPECT_EQ(c.adders(), 4 * 5 + 2 * 11);
  EXPECT_EQ(c.rom_bits(), 4 * 8 * 1024);
}

// The guard bits of narrow highlights leave fewer for the fraction.
TEST(DatapathConfiguration, SeriesOfTheOctaveLayoutsEndAt40BitsToo) {
  DatapathConfiguration c;
  c.rom_layout = RomLayout::bipartite;
  c.rom_address_bits = 13;
  c.specular_guard_bits = 12;
  c.specular_fraction_bits = 14;
  EXPECT_EQ(c.specular_width(), kWidestSeries);
  c.check();
  c.specular_fraction_bits = 17;
  try {
    c.check();
    FAIL() << "43 bits";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("specular_fraction_bits = 17: at most 14"),
              std::string::npos)
        << error.what();
  }
}

// The paper's claim: 2 additions a pixel for diffuse light, 5 for full Phong.
TEST(DatapathConfiguration, AddsFiveTimesAPixel) {
  DatapathConfiguration c;
  EXPECT_EQ(c.series(), 2);
  EXPECT_EQ(c.adders(), 5);
  c.gate = GateSource::series;
  EXPECT_EQ(c.adders(), 7);
  c.channels = 3;
  EXPECT_EQ(c.series(), 5);
  EXPECT_EQ(c.adders(), 13);
}

}  // namespace
}  // namespace phongpipe
