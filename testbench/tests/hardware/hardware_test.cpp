// Hardware files, settings, their hash, and technology cards.
#include "testbench/hardware/hardware.h"

#include <gtest/gtest.h>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

TEST(Hardware, PresetsAreThePapersTables) {
  const Hardware small = load_hardware("paper-1k", {});
  EXPECT_EQ(small.datapath.rom_words(), 1024);
  EXPECT_EQ(small.datapath.rom_data_bits, 8);
  EXPECT_EQ(small.datapath.diffuse_width(), 26);
  EXPECT_EQ(small.datapath.specular_width(), 24);
  EXPECT_EQ(load_hardware("paper-8k", {}).datapath.rom_words(), 8192);
}

TEST(Hardware, EverySettingTakesItsOwnValue) {
  Hardware hardware = load_hardware("paper-1k", {});
  for (const Setting& setting : settings(hardware)) {
    const Hardware same = load_hardware("paper-1k", {setting.name() + "=" + setting.value()});
    EXPECT_EQ(configuration_hash(same), configuration_hash(hardware)) << setting.name();
  }
}

TEST(Hardware, EverySettingChangesTheHash) {
  Hardware hardware = load_hardware("paper-1k", {});
  hardware.choose_channels = false;
  const std::string before = configuration_hash(hardware);
  for (const Setting& setting : settings(hardware)) {
    const int value = setting.get();
    setting.put(setting.key == "channels" ? 2
                : setting.choices.empty() ? value + 1
                : value == 0              ? 1
                                          : 0);
    EXPECT_NE(configuration_hash(hardware), before) << setting.name();
    setting.put(setting.key == "channels" ? 1 : value);
  }
  EXPECT_EQ(configuration_hash(hardware), before);
}

TEST(Hardware, OnlyTheDefaultSplitsTriangles) {
  EXPECT_GT(load_hardware("default", {}).datapath.subdivide_degrees, 0);
  EXPECT_EQ(load_hardware("paper-1k", {}).datapath.subdivide_degrees, 0);
  EXPECT_EQ(load_hardware("paper-8k", {}).datapath.subdivide_degrees, 0);
  try {
    load_hardware("default", {"subdivide_degrees=181"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "--set subdivide_degrees=181: setup_engine.subdivide_degrees = 181 is out of "
                 "range: 0 to 180 (0: never)");
  }
}

TEST(Technology, ClockOfTheNextWiderPoint) {
  const Technology card = load_technology("ice40-hx8k");
  DatapathConfiguration c;
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
  DatapathConfiguration c;
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
  DatapathConfiguration c;
  c.diffuse_fraction_bits = kMaxDiffuseFraction;
  c.specular_fraction_bits = kMaxSpecularFraction;
  c.rom_address_bits = kMaxRomAddressBits;
  EXPECT_GT(card.clock_ns(c), 9.2);
}

}  // namespace
}  // namespace phongpipe
