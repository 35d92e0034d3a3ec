// compare: page, tables and curves.
#include <gtest/gtest.h>

#include <filesystem>

#include "model/files/text_file.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, CompareWritesAPageTablesAndCurves) {
  const ProcessOutput output = run({"compare", "sphere", "--out", folder_.string(), "--json",
                                    file("c.json"), "--csv", file("c.csv")});
  ASSERT_EQ(output.status, 0) << output.text;
  const std::string page = read_whole_file(file("sphere-methods.html"));
  for (const char* word : {"\"render\"", "\"--method\"", "\"gouraud\""}) {
    EXPECT_NE(page.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.find("iVBORw0KGgo"), std::string::npos) << "a picture";
  EXPECT_TRUE(fs::exists(file("sphere-gouraud-error.png")));
  EXPECT_EQ(json("c.json")[0]["methods"][0]["method"], "flat");
  ASSERT_EQ(run({"compare", "--curve", "size", "--out", folder_.string()}).status, 0);
  EXPECT_EQ(read_whole_file(file("size.svg")).substr(0, 4), "<svg");
  expect_refused({"compare"}, "nothing to compare");
  expect_refused({"compare", "--curve", "colour"}, "curvature");
  expect_refused({"compare", "--curve", "max-error"}, "compare SCENE --curve max-error");
}

TEST_F(Program, ComparedJsonAloneGoesToStandardOutput) {
  const ProcessOutput output = run_for_answer("compare sphere --json -");
  EXPECT_TRUE(nlohmann::json::accept(output.text)) << output.text;
}

}  // namespace
}  // namespace phongpipe
