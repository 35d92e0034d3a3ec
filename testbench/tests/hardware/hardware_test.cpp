// Hardware files, settings, their hash, and technology cards.
#include "testbench/hardware/hardware.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/system/installation.h"
#include "testbench/system/output_file.h"

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

DatapathConfiguration of_preset(const char* preset) {
  DatapathConfiguration datapath{load_hardware(preset, {}).formats, {}};
  datapath.specular_guard_bits = least_specular_guard_bits(datapath.rom_layout);
  return datapath;
}

TEST(Technology, PresetsAreMeasured) {
  for (const char* name : {"ice40-hx8k", "ice40-up5k"}) {
    const Technology card = load_technology(name);
    for (const char* preset : {"default", "paper-1k", "paper-8k"}) {
      const ClockFigure clock = card.clock(of_preset(preset));
      EXPECT_EQ(clock.kind, FigureKind::measured) << name << " " << preset;
      EXPECT_EQ(kind_text(clock), "measured");
      EXPECT_NE(clock.limited_by, "");
      const auto area = card.area(of_preset(preset));
      ASSERT_TRUE(area.has_value());
      EXPECT_EQ(area->kind, FigureKind::measured);
      EXPECT_TRUE(area->block_rams.has_value());
    }
  }
}

// The clock that pixel_datapath must reach, in ns.
TEST(Technology, PresetsAreAsFastAsTheyMustBe) {
  const Technology large = load_technology("ice40-hx8k"), small = load_technology("ice40-up5k");
  for (const char* preset : {"default", "paper-1k", "paper-8k"}) {
    EXPECT_LE(large.clock(of_preset(preset)).ns, 5.5) << preset;
    EXPECT_LE(small.clock(of_preset(preset)).ns, 13.5) << preset;
  }
}

TEST(Technology, OtherConfigurationsAreFittedWithinAStatedError) {
  for (const char* name : {"ice40-hx8k", "ice40-up5k"}) {
    const Technology card = load_technology(name);
    DatapathConfiguration c = of_preset("paper-1k");
    c.diffuse_fraction_bits = 17;
    const ClockFigure clock = card.clock(c);
    EXPECT_EQ(clock.kind, FigureKind::fitted);
    EXPECT_EQ(clock.relative_error, card.fitted.at("pixel_datapath").clock_ns.relative_error);
    EXPECT_EQ(kind_text(clock).rfind("fitted ± ", 0), 0U) << kind_text(clock);
    EXPECT_NEAR(clock.ns / card.clock(of_preset("paper-1k")).ns, 1, 0.3);
    const auto area = card.area(c);
    EXPECT_EQ(area->kind, FigureKind::fitted);
    EXPECT_FALSE(area->block_rams.has_value());
    EXPECT_GT(area->luts, card.area(of_preset("paper-1k"))->luts - 30);
  }
}

TEST(Technology, ADesignThatIsTooLargeForTheDeviceIsToldSo) {
  DatapathConfiguration c = of_preset("default");
  c.channels = 3;
  c.kind = DatapathKind::wide4;
  const ClockFigure clock = load_technology("ice40-hx8k").clock(c);
  EXPECT_TRUE(clock.too_large);
  EXPECT_NE(kind_text(clock).find("too large for the device"), std::string::npos);
  c.kind = DatapathKind::wide2;
  EXPECT_FALSE(load_technology("ice40-hx8k").clock(c).too_large);
}

TEST(Technology, EveryLegalConfigurationHasAClock) {
  const Technology card = load_technology("ice40-hx8k");
  for (const bool highest : {false, true}) {
    DatapathConfiguration c;
    c.channels = highest ? 3 : 1;
    c.depth_cue = highest;
    for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
      if (!setting.rtl_parameter.empty()) setting.put(c, highest ? setting.high : setting.low);
    }
    EXPECT_GT(card.clock(c).ns, 3);
    EXPECT_LT(card.clock(c).ns, 20);
    EXPECT_GT(card.area(c)->luts, 100);
  }
}

TEST(Technology, CardsWithAFixedClockAssumeIt) {
  const Technology card = load_technology("generic");
  EXPECT_DOUBLE_EQ(card.clock({}).ns, 20);
  EXPECT_EQ(kind_text(card.clock({})), "assumed");
  EXPECT_FALSE(card.area({}).has_value());
  EXPECT_EQ(load_technology("ttl-1986").clock({}).limited_by, "exponent_rom");
}

TEST(Technology, ACardWithoutANeededFigureIsRefused) {
  const std::string file = testing::TempDir() + "phongpipe-card.toml";
  const std::string text = read_whole_file(installation().hardware / "technology/ice40-hx8k.toml");
  for (const char* line : {"package = ", "relative_error = ", "constant = ", "slowest_ns = "}) {
    std::string broken = text;
    const std::size_t at = broken.find(line);
    broken.erase(at, broken.find('\n', at) - at);
    write_text(file, broken);
    try {
      load_technology(file);
      ADD_FAILURE() << "accepted without " << line;
    } catch (const InputError& error) {
      const std::string key(line, std::string_view(line).find(' '));
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace phongpipe
