// render: pictures by the hardware and by any method.
#include <gtest/gtest.h>

#include <filesystem>

#include "model/files/text_file.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, RenderWritesPngPfmAndTriangles) {
  ASSERT_EQ(
      run({"render", "sphere", "-o", file("a.png"), "--dump-triangles", file("t.csv")}).status, 0);
  EXPECT_EQ(read_whole_file(file("t.csv")).substr(0, 9), "x0,y0,z0,");
  ASSERT_EQ(
      run({"render", "sphere", "--method", "phong", "--arithmetic", "real", "-o", file("a.pfm")})
          .status,
      0);
  const std::string pfm = read_whole_file(file("a.pfm"));
  const std::string header = "PF\n256 256\n-1.0\n";
  EXPECT_EQ(pfm.substr(0, header.size()), header);
  EXPECT_EQ(pfm.size(), header.size() + 256U * 256 * 3 * 4);
  EXPECT_EQ(run({"render", "sphere", "--arithmetic", "real", "-o", file("b.png")}).status, 0);
}

// A picture by no method is the hardware's; by a method of the pipeline in fixed arithmetic it is
// the hardware's with that series.
TEST_F(Program, RenderShowsWhatTheHardwareComputes) {
  const auto picture = [this](std::vector<std::string> how) {
    how.insert(how.begin(), {"render", "sphere", "-o", file("p.pfm")});
    EXPECT_EQ(run(how).status, 0);
    return read_whole_file(file("p.pfm"));
  };
  const std::string own = picture({});
  EXPECT_EQ(own, picture({"--method", "weighted", "--arithmetic", "fixed"}));
  const std::string paper = picture({"--set", "series=taylor", "--set", "subdivide_degrees=0"});
  EXPECT_EQ(paper, picture({"--method", "taylor", "--arithmetic", "fixed"}));
  EXPECT_NE(own, paper);
  EXPECT_NE(paper, picture({"--method", "taylor"}));
}

TEST_F(Program, RenderTakesAnyMethodAndRefusesByName) {
  EXPECT_EQ(run({"render", "teapot", "--method", "gouraud", "-o", file("g.png")}).status, 0);
  expect_refused({"render", "torus", "--method", "otm", "-o", file("o.png")},
                 "otm cannot render it");
  expect_refused({"render", "torus", "--method", "goraud", "-o", file("o.png")},
                 "did you mean gouraud");
}

TEST_F(Program, RenderTellsThatAPictureIsEmpty) {
  const std::string scene = write_empty_picture();
  for (const char* how : {"fixed", "real"}) {
    const ProcessOutput output = run({"render", scene, "--arithmetic", how, "-o", file("a.png")});
    EXPECT_EQ(output.status, 0) << output.text;
    EXPECT_NE(output.text.find("note: " + scene + ": nothing of the scene covers a pixel"),
              std::string::npos)
        << output.text;
    EXPECT_TRUE(fs::remove(file("a.png"))) << how;
  }
  EXPECT_EQ(lines_of(run({"render", "sphere", "-o", file("b.png")}).text), 0);
}

TEST_F(Program, PhongRendersWhatThePipelineRefuses) {
  std::string text = shipped_scene("sphere");
  text.replace(text.find("shininess"), 0, "shininess = 0 # ");
  const std::string scene = write(
      "blunt.toml",
      text + "\n[[light]]\ntype = \"point\"\nposition = [3, 3, 3]\nattenuation = [1, 0, 1]\n");
  EXPECT_EQ(run({"render", scene, "--method", "phong", "-o", file("a.png")}).status, 0);
  fs::remove(file("a.png"));
  expect_refused({"render", scene, "-o", file("b.png")},
                 "a shininess of 0 under a light that fades");
  expect_refused({"verify", scene, "--out", file("pictures")},
                 "blunt.toml: material grey: a shininess of 0 under a light that fades");
}

}  // namespace
}  // namespace phongpipe
