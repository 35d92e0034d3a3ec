// Plans of sweeps: lists and ranges, ties, conditions, samples, and mistakes.
#include "testbench/campaign/plan.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

using Values = std::vector<std::string>;

Values values_of(const std::string& text) {
  return parse_axis("rom_address_bits=" + text).values;
}

TEST(Plan, ListsAndRanges) {
  EXPECT_EQ(values_of("6,8,13"), (Values{"6", "8", "13"}));
  EXPECT_EQ(values_of("6:9"), (Values{"6", "7", "8", "9"}));
  EXPECT_EQ(values_of("4:24:10"), (Values{"4", "14", "24"}));
  EXPECT_EQ(values_of("4:23:10"), (Values{"4", "14"}));
  EXPECT_EQ(values_of("9:6"), (Values{"9", "8", "7", "6"}));
  EXPECT_EQ(values_of("6, 8:10, 13"), (Values{"6", "8", "9", "10", "13"}));
  EXPECT_EQ(values_of("0.1:0.3:0.1"), (Values{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(parse_axis("scene.light.0.color=[1,1,1],[1,0,0]").values,
            (Values{"[1,1,1]", "[1,0,0]"}));
}

TEST(Plan, KeysGetTheirFullNames) {
  EXPECT_EQ(parse_axis("rom_address_bits=6").key, "datapath.rom_address_bits");
  EXPECT_EQ(parse_axis("setup_engine.series=taylor,weighted").key, "setup_engine.series");
  EXPECT_EQ(parse_axis("stall=0,25").key, "stall");
  EXPECT_EQ(parse_axis("scene.material.gold.shininess=5:10").key, "scene.material.gold.shininess");
}

void expect_mistake(const std::string& text, const std::string& message) {
  try {
    parse_axis(text);
    FAIL() << text << " was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(Plan, MistakesInAnAxisSayWhatWouldBeRight) {
  expect_mistake("rom_adress_bits=6", "did you mean rom_address_bits?");
  expect_mistake("rom_address_bits", "write KEY=VALUE");
  expect_mistake("rom_address_bits=6:13:0", "a step of 0");
  expect_mistake("rom_address_bits=6:13:-1", "no value lies from 6 to 13");
  expect_mistake("rom_address_bits=", "an empty value");
  expect_mistake("rom_address_bits=6,,7", "an empty value");
  expect_mistake("rom_address_bits=6,7,6", "6 stands there twice");
  expect_mistake("seed=0:1e9", "at most 100000");
}

Plan plan_of(const Values& axes) {
  Plan plan;
  plan.base.scene = "teapot";
  for (const std::string& axis : axes) plan.axes.push_back(parse_axis(axis));
  return plan;
}

TEST(Plan, TheFirstAxisVariesSlowest) {
  const auto points = points_of(plan_of({"rom_address_bits=6,7", "stall=0,25"}));
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[1].request.settings, Values{"datapath.rom_address_bits=6"});
  EXPECT_EQ(points[1].request.options.stall_percent, 25);
  EXPECT_EQ(points[2].request.settings, Values{"datapath.rom_address_bits=7"});
  EXPECT_EQ(points[2].request.options.stall_percent, 0);
}

TEST(Plan, TiesFollowAndConditionsLeaveOut) {
  Plan plan = plan_of({"rom_address_bits=6:13", "series=taylor,weighted"});
  plan.ties.push_back(parse_tie("specular_fraction_bits=22 - rom_address_bits"));
  plan.conditions = {"datapath.rom_address_bits > 9 && specular_fraction_bits != 11",
                     "series == weighted"};
  const auto points = points_of(plan);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].values, (std::vector<std::pair<std::string, std::string>>{
                                  {"datapath.rom_address_bits", "12"},
                                  {"setup_engine.series", "weighted"},
                                  {"datapath.specular_fraction_bits", "10"}}));
  EXPECT_EQ(points[1].request.settings,
            (Values{"datapath.rom_address_bits=12", "setup_engine.series=weighted",
                    "datapath.specular_fraction_bits=10"}));
}

// Also series, which is a word for another key, too.
TEST(Plan, ConditionsOnWhatDoesNotVaryAreErrors) {
  const auto expect_mistake = [](const char* condition, const char* message) {
    Plan plan = plan_of({"rom_address_bits=6:13"});
    plan.conditions = {condition};
    try {
      points_of(plan);
      ADD_FAILURE() << condition;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), fmt::format("{}: {}", condition, message));
    }
  };
  expect_mistake("series == weighted", "series does not vary");
  expect_mistake("rom_address_bits > 8 && datapath.kind == serial", "datapath.kind does not vary");
  expect_mistake("rom_adress_bits > 8",
                 "rom_adress_bits is no name of what varies; did you mean rom_address_bits?");
  expect_mistake("rom_address_bits == nonsense", "nonsense is no name of what varies");
}

TEST(Plan, MistakesInExpressionsAreErrors) {
  Plan plan = plan_of({"rom_address_bits=6:13"});
  plan.conditions = {"rom_adress > 9"};
  EXPECT_THROW(points_of(plan), InputError);
  plan.conditions = {"rom_address_bits >"};
  EXPECT_THROW(points_of(plan), InputError);
  plan.conditions = {"rom_address_bits = 8"};
  EXPECT_THROW(points_of(plan), InputError) << "an assignment";
  plan.conditions = {"rom_address_bits>0" + std::string(20'000, '+') + "0"};
  EXPECT_THROW(points_of(plan), InputError) << "too long";
  plan.conditions = {"1 / (rom_address_bits - 6)"};
  EXPECT_THROW(points_of(plan), InputError);
  plan.conditions = {"rom_address_bits > 13"};
  EXPECT_THROW(points_of(plan), InputError) << "no point is left";
  plan.conditions.clear();
  plan.ties.push_back(parse_tie("rom_address_bits=5"));
  EXPECT_THROW(points_of(plan), InputError) << "varies twice";
  plan.ties = {parse_tie("specular_fraction_bits=diffuse_fraction_bits"),
               parse_tie("diffuse_fraction_bits=rom_address_bits")};
  EXPECT_THROW(points_of(plan), InputError) << "a tie uses a later one";
  std::swap(plan.ties[0], plan.ties[1]);
  EXPECT_EQ(points_of(plan).front().values.back().second, "6");
}

TEST(Plan, WordsOfAnAxisCanBeCompared) {
  Plan plan = plan_of({"technology=generic,ice40-hx8k", "scene=teapot,pawn"});
  plan.conditions = {"technology == generic", "scene != pawn"};
  EXPECT_EQ(points_of(plan).size(), 1U);
}

TEST(Plan, ANameThatTwoKeysShareIsNone) {
  Plan plan = plan_of({"scene.material.a.shininess=1,20", "scene.material.b.shininess=1,20"});
  plan.conditions = {"shininess > 10"};
  EXPECT_THROW(points_of(plan), InputError);
  plan.conditions = {"scene.material.a.shininess > 10"};
  EXPECT_EQ(points_of(plan).size(), 2U);
}

TEST(Plan, ALargeSpaceIsSampledOrRefusedButNotEnumerated) {
  Plan plan = plan_of({"seed=0:9999", "stall=0:99", "rom_address_bits=6:13",
                       "diffuse_fraction_bits=4:30", "specular_fraction_bits=1:25"});
  EXPECT_EQ(grid_size(plan), 10'000ULL * 100 * 8 * 27 * 25);
  EXPECT_THROW(points_of(plan), InputError);
  plan.sample = 500;
  plan.seed = 7;
  const auto points = points_of(plan);
  EXPECT_EQ(points.size(), 500U);
  std::set<Values> distinct;
  for (const PlanPoint& point : points) {
    Values values;
    for (const auto& [key, value] : point.values) values.push_back(value);
    distinct.insert(values);
  }
  EXPECT_EQ(distinct.size(), 500U);
  const auto again = points_of(plan);
  EXPECT_EQ(points.front().values, again.front().values);
  plan.seed = 8;
  EXPECT_NE(points.front().values, points_of(plan).front().values);
}

TEST(Plan, ASampleOfASmallSpaceKeepsConditionsAndTheOrderOfTheGrid) {
  Plan plan = plan_of({"diffuse_fraction_bits=4:30"});
  plan.conditions = {"diffuse_fraction_bits < 10"};
  plan.sample = 20;
  const auto points = points_of(plan);
  EXPECT_EQ(points.size(), 6U) << "as many as there are";
  EXPECT_EQ(points.front().values.front().second, "4");
}

// Every shipped sweep is a legal plan, of a size that a coffee break allows.
TEST(Plan, ShippedSweepsAreLegal) {
  const std::filesystem::path folder = std::string(PHONGPIPE_SOURCES) + "/testbench/sweeps";
  const std::vector<std::string> names = names_in(folder);
  EXPECT_EQ(names, (Values{"mantissa", "series", "sizes", "tables", "widths"}));
  for (const std::string& name : names) {
    Plan plan;
    read_sweep_file(folder / (name + ".toml"), plan);
    const auto points = points_of(plan);
    EXPECT_GT(points.size(), 20U) << name;
    EXPECT_LT(points.size(), 1000U) << name;
    for (const PlanPoint& point : points) {
      EXPECT_NO_THROW(load_hardware(point.request.hardware, point.request.settings)) << name;
    }
    EXPECT_NO_THROW(
        load_named_scene(points.front().request.scene, points.front().request.settings));
  }
}

}  // namespace
}  // namespace phongpipe
