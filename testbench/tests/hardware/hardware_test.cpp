// Hardware files, settings, their hash, and technology cards.
#include "testbench/hardware/hardware.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/scene/input_error.h"
#include "testbench/cases/format_range.h"

namespace phongpipe {
namespace {

DatapathConfiguration datapath_of(const std::string& preset) {
  return {load_hardware(preset, {}).formats, {}};
}

TEST(Hardware, PresetsAreThePapersTables) {
  const DatapathConfiguration small = datapath_of("paper-1k");
  EXPECT_EQ(small.rom_words(), 1024);
  EXPECT_EQ(small.rom_data_bits, 8);
  EXPECT_EQ(small.diffuse_width(), 26);
  EXPECT_EQ(small.specular_width(), 24);
  EXPECT_EQ(datapath_of("paper-8k").rom_words(), 8192);
}

TEST(Hardware, EverySettingTakesItsOwnValue) {
  const Hardware hardware = load_hardware("paper-1k", {});
  for (const Setting<Hardware>& setting : hardware_settings()) {
    const Hardware same =
        load_hardware("paper-1k", {setting.name() + "=" + setting.value(hardware)});
    EXPECT_EQ(configuration_hash(same), configuration_hash(hardware)) << setting.name();
  }
}

TEST(Hardware, EverySettingChangesTheHashAndIsExplained) {
  const Hardware hardware = load_hardware("paper-1k", {});
  for (const Setting<Hardware>& setting : hardware_settings()) {
    EXPECT_FALSE(setting.meaning.empty()) << setting.name();
    EXPECT_LT(setting.low, setting.high) << setting.name();
    Hardware changed = hardware;
    const int value = setting.get(hardware);
    setting.put(changed, value < setting.high ? value + 1 : value - 1);
    EXPECT_NE(configuration_hash(changed), configuration_hash(hardware)) << setting.name();
    setting.put(changed, value);
    EXPECT_EQ(configuration_hash(changed), configuration_hash(hardware)) << setting.name();
  }
}

// Both ends of every range are legal, what lies beyond is refused by key and range.
TEST(Hardware, EveryRangeIsHeldAtBothEnds) {
  for (const Setting<Hardware>& setting : hardware_settings()) {
    Hardware hardware;
    for (const int legal : {setting.low, setting.high}) {
      setting.put(hardware, legal);
      EXPECT_NO_THROW(setting.check(hardware)) << setting.name() << " = " << legal;
    }
    if (!setting.choices.empty()) continue;
    for (const int illegal : {setting.low - 1, setting.high + 1}) {
      try {
        load_hardware("default", {setting.name() + "=" + setting.text(illegal)});
        FAIL() << setting.name() << " = " << illegal << " is taken";
      } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find(fmt::format("{} = {} is out of range: {} to {}", setting.name(),
                                           setting.text(illegal), setting.text(setting.low),
                                           setting.text(setting.high))),
                  std::string::npos)
            << message;
      }
    }
  }
}

TEST(Hardware, OnlyTheDefaultSplitsTriangles) {
  EXPECT_GT(load_hardware("default", {}).setup.subdivide_degrees, 0);
  EXPECT_EQ(load_hardware("paper-1k", {}).setup.subdivide_degrees, 0);
  EXPECT_EQ(load_hardware("paper-8k", {}).setup.subdivide_degrees, 0);
}

TEST(Technology, ClockOfTheNextWiderPoint) {
  const Technology card = load_technology("ice40-hx8k");
  FrameConfiguration c;
  c.diffuse_fraction_bits = 14;  // 24 bits
  c.specular_fraction_bits = 4;
  EXPECT_DOUBLE_EQ(card.clock_ns(c), 7.1);
  c.diffuse_fraction_bits = 15;  // 25 bits: the point of 28
  EXPECT_DOUBLE_EQ(card.clock_ns(c), 7.4);
  c.rom_address_bits = 6;  // smaller tables than were measured cost no more
  EXPECT_DOUBLE_EQ(card.clock_ns(c), 7.4);
}

TEST(Technology, LargerTablesAddWhatTheyAddWhereBothWereMeasured) {
  const Technology card = load_technology("ice40-hx8k");
  FrameConfiguration c;
  c.diffuse_fraction_bits = 14;
  c.specular_fraction_bits = 4;
  c.rom_address_bits = 13;
  EXPECT_DOUBLE_EQ(card.clock_ns(c), 9.6);
  c.diffuse_fraction_bits = 30;
  EXPECT_DOUBLE_EQ(card.clock_ns(c), 9.2 + (9.6 - 7.1));
  c.rom_address_bits = 11;  // between the sizes: the larger one's clock
  EXPECT_DOUBLE_EQ(card.clock_ns(c), 9.2 + (9.6 - 7.1));
}

TEST(Technology, GenericIsFixed) {
  const Technology card = load_technology("generic");
  EXPECT_DOUBLE_EQ(card.clock_ns({}), 20);
}

TEST(Technology, EveryLegalConfigurationHasAClock) {
  const Technology card = load_technology("ice40-hx8k");
  FrameConfiguration c;
  c.diffuse_fraction_bits = kMaxDiffuseFraction;
  c.specular_fraction_bits = kMaxSpecularFraction;
  c.rom_address_bits = kMaxRomAddressBits;
  EXPECT_GT(card.clock_ns(c), 9.2);
}

}  // namespace
}  // namespace phongpipe
