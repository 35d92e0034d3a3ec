// Several scenes in one run of verify.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, SeveralScenesAreALineEachAndAnArray) {
  const ProcessOutput output = run_for_answer("verify sphere two-planes --json " + file("r.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 3) << output.text;
  EXPECT_EQ(output.text.rfind("PASSED sphere", 0), 0U) << output.text;
  EXPECT_NE(output.text.find("2 of 2 passed\n"), std::string::npos) << output.text;
  EXPECT_EQ(json("r.json").size(), 2U);
}

// A scene that turns out to be no picture keeps nobody from the results of the others.
TEST_F(Program, EverySceneHasAResultWhereOneIsRefused) {
  const std::string away = write_empty_picture();
  const ProcessOutput output =
      run({"verify", "sphere", away, "two-planes", "--json", file("r.json")});
  EXPECT_EQ(output.status, 2) << output.text;
  EXPECT_NE(output.text.find("2 of 3 passed"), std::string::npos) << output.text;
  const nlohmann::json results = json("r.json");
  ASSERT_EQ(results.size(), 3U);
  EXPECT_TRUE(results[0]["passed"]);
  EXPECT_NE(results[1]["error"].get<std::string>().find("covers a pixel"), std::string::npos);
  EXPECT_TRUE(results[2]["passed"]);
  expect_refused({"verify", "sphere", "nosuch", "--json", file("s.json")}, "no such file or scene");
}

TEST_F(Program, ScenesOfOneNameKeepTheirPicturesApart) {
  fs::create_directories(folder_ / "other");
  const std::string text = shipped_scene("two-planes");
  const std::string first = write("planes.toml", text), second = write("other/planes.toml", text);
  ASSERT_EQ(run({"verify", first, second, "--out", file("pictures")}).status, 0);
  for (const char* picture : {"planes-result.png", "planes-2-result.png"}) {
    EXPECT_TRUE(fs::exists(folder_ / "pictures" / picture)) << picture;
  }
}

}  // namespace
}  // namespace phongpipe
