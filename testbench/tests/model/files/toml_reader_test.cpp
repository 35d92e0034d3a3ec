#include "model/files/toml_reader.h"

#include <gtest/gtest.h>

#include "model/files/spelling.h"
#include "testbench/tests/model/scene/scene_files.h"

namespace phongpipe {
namespace {

class TomlReader : public ::testing::Test {
 protected:
  TomlTable read(const std::string& text) {
    return TomlTable::read_file(folder_.write("t.toml", text));
  }
  template <class Action>
  std::string error(Action action) {
    return error_of(folder_, action);
  }
  TempFolder folder_;
};

TEST_F(TomlReader, GivesValuesAndFallbacks) {
  const TomlTable root = read("on = true\nname = 'x'\ncount = 3\nratio = 2\n");
  EXPECT_TRUE(root.boolean("on"));
  EXPECT_TRUE(root.boolean("off", true));
  EXPECT_EQ(root.text("name"), "x");
  EXPECT_EQ(root.text("title", "none"), "none");
  EXPECT_EQ(root.integer("count", 0, 3), 3);
  EXPECT_EQ(root.integer("missing", 0, 3, 7), 7);
  EXPECT_EQ(root.number("ratio", {}), 2.0) << "a whole number is a number";
  EXPECT_EQ(root.number("absent", {}, 0.5), 0.5);
  EXPECT_NO_THROW(root.finish());
}

TEST_F(TomlReader, RefusesWrongTypes) {
  const TomlTable root = read("on = 1\nname = ''\ncount = 3.0\nhuge = 99999999999\nratio = true\n");
  EXPECT_EQ(error([&] { root.boolean("on"); }), "t.toml:1: on must be true or false");
  EXPECT_EQ(error([&] { root.text("name"); }),
            "t.toml:2: name must be a string in quotes, not empty");
  EXPECT_EQ(error([&] { root.integer("count", 0, 9); }), "t.toml:3: count must be a whole number");
  EXPECT_EQ(error([&] { root.integer("huge", 0, 9); }),
            "t.toml:4: huge is 99999999999, must be from 0 to 9");
  EXPECT_EQ(error([&] { root.number("ratio", {}); }), "t.toml:5: ratio must be a number");
  EXPECT_EQ(error([&] { root.number("none", {}); }), "t.toml: missing 'none'");
}

TEST_F(TomlReader, NamedTablesKeepTheOrderOfTheFile) {
  const auto tables = read("[material.z]\na = 1\n[material.b]\na = 2\n").named_tables("material");
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].first, "z");
  EXPECT_EQ(tables[1].second.line(), 3U);
  EXPECT_TRUE(read("a = 1\n").named_tables("material").empty());
}

TEST_F(TomlReader, FinishNamesTheLikelyKey) {
  const TomlTable table = read("[rom]\nadress_bits = 9\n").table("rom");
  table.integer("address_bits", 1, 12, 8);
  EXPECT_EQ(error([&] { table.finish(); }),
            "t.toml:2: unknown key 'adress_bits' in [rom], did you mean 'address_bits'?");
}

TEST(Spelling, OnlyCloseWordsAreOffered) {
  const std::vector<std::string> words = {"width", "height", "background"};
  EXPECT_EQ(closest_word("widht", words), "width");
  EXPECT_EQ(closest_word("heigth", words), "height");
  EXPECT_EQ(closest_word("depth", words), "");
}

}  // namespace
}  // namespace phongpipe
