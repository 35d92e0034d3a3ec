// compare: page, tables and curves.
#include <gtest/gtest.h>

#include <filesystem>

#include "model/files/text_file.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, CompareWritesAPageAndTables) {
  const ProcessOutput output = run({"compare", "sphere", "--out", folder_.string(), "--json",
                                    file("c.json"), "--csv", file("c.csv")});
  ASSERT_EQ(output.status, 0) << output.text;
  // The answer, and the files that were written, before the table.
  const std::string answer = output.text.substr(0, output.text.find("\n\n"));
  EXPECT_EQ(
      answer.rfind("sphere: 27 of 28 methods render it.\nLeast error for their time: flat ", 0), 0U)
      << output.text;
  EXPECT_NE(answer.find("\nHardware default has weighted: "), std::string::npos) << answer;
  EXPECT_NE(answer.find("\n  more     " + file("sphere-methods.html") + ", " +
                        file("sphere-methods.svg") + ", " + file("sphere-area.svg")),
            std::string::npos)
      << answer;
  EXPECT_EQ(lines_of(answer), 5) << answer;
  EXPECT_LT(answer.size(), output.text.find("\nmethod ")) << output.text;
  const std::string page = read_whole_file(file("sphere-methods.html"));
  for (const char* word : {"\"render\"", "\"--method\"", "\"gouraud\""}) {
    EXPECT_NE(page.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.find("iVBORw0KGgo"), std::string::npos) << "a picture";
  EXPECT_TRUE(fs::exists(file("sphere-gouraud-error.png")));
  EXPECT_EQ(json("c.json")[0]["methods"][0]["method"], "flat");
  expect_refused({"compare"}, "nothing to compare");
  expect_refused({"compare", "--curve", "colour"}, "curvature");
  expect_refused({"compare", "--curve", "max-error"}, "compare SCENE --curve max-error");
}

TEST_F(Program, CurvesAreToldInAFewLinesAndWrittenWhereAsked) {
  const ProcessOutput told = run({"compare", "--curve", "size", "--out", folder_.string()});
  ASSERT_EQ(told.status, 0) << told.text;
  EXPECT_EQ(told.text.rfind("Time of diffuse light\n  clocks a pixel, set-up included, over ", 0),
            0U)
      << told.text;
  EXPECT_LT(lines_of(told.text), 35) << told.text;
  EXPECT_NE(told.text.find("  more     " + file("size-diffuse.csv") + ", "), std::string::npos)
      << told.text;
  EXPECT_EQ(read_whole_file(file("size.svg")).substr(0, 4), "<svg");

  const ProcessOutput csv = run_for_answer("compare --curve size --csv -");
  EXPECT_EQ(csv.text.rfind("# Time of diffuse light\nx,flat,", 0), 0U) << csv.text;
  const ProcessOutput answer =
      run_for_answer("compare --curve size --json - --csv " + file("all.csv"));
  const auto curves = nlohmann::json::parse(answer.text);
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_EQ(curves[0]["title"], "Time of diffuse light");
  EXPECT_EQ(curves[0]["series"][0]["points"][0][0], 1);
  EXPECT_EQ(read_whole_file(file("all.csv")), csv.text);
}

// The blocks of the pipeline are timed for the scene that is given.
TEST_F(Program, TheCurveOfSizesIsOfItsScene) {
  const auto curves =
      nlohmann::json::parse(run_for_answer("compare torus --curve size --json -").text);
  EXPECT_NE(curves[2]["title"].get<std::string>().find("torus"), std::string::npos) << curves[2];
}

TEST_F(Program, CompareLeavesNothingOutWithoutAWord) {
  expect_refused({"compare", "sphere", "--json", "-", "--csv", "-"}, "give one of them a file");
  expect_refused({"compare", "sphere", "--curve", "exponent"}, "leave out sphere");
  expect_refused({"compare", "sphere", "torus", "--curve", "size"}, "is of one scene");
  expect_refused({"compare", "--microvax", "--json", "-"}, "--microvax is a table by itself");
  expect_refused({"compare", "sphere", "--microvax"}, "--microvax is a table by itself");
  EXPECT_EQ(run({"compare", "--microvax"}).status, 0);
}

TEST_F(Program, CompareAnswersForEachScene) {
  const std::string text = run_for_answer("compare screen-triangles two-planes").text;
  EXPECT_EQ(text.rfind("screen-triangles: ", 0), 0U) << text;
  EXPECT_NE(text.find("\n\nscreen-triangles: 6 triangles, "), std::string::npos) << text;
  EXPECT_NE(text.find("\n\ntwo-planes: "), std::string::npos) << text;
}

TEST_F(Program, ComparedJsonAloneGoesToStandardOutput) {
  const ProcessOutput output = run_for_answer("compare sphere --json -");
  EXPECT_TRUE(nlohmann::json::accept(output.text)) << output.text;
}

}  // namespace
}  // namespace phongpipe
