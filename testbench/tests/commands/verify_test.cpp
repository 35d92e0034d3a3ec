// verify: what it checks, of which scenes and hardware.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "testbench/system/installation.h"
#include "testbench/system/process.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

// Two lights, colour, a depth cue and materials of which one is matt.
constexpr const char* kEffectsScene = R"([image]
width = 96
height = 64
background = [0.1, 0.2, 0.3]
[camera]
projection = "perspective"
eye = [0, 1, 5]
target = [0, 0, 0]
vertical_fov_degrees = 30
[[light]]
type = "directional"
direction = [-1, -1, -1]
color = [1, 0.8, 0.6]
[[light]]
type = "directional"
direction = [1, -0.5, -1]
color = [0, 0.3, 0.6]
[depth_cue]
near = 4
far = 6
color = [0.1, 0.2, 0.3]
[[object]]
primitive = "torus"
material = "shiny"
[[object]]
primitive = "sphere"
scale = 0.4
material = "matt"
[material.shiny]
ambient = 0.1
diffuse = [0.6, 0.5, 0.4]
specular = 0.3
shininess = 20
[material.matt]
ambient = 0.1
diffuse = 0.7
specular = 0
shininess = 20
)";

const std::string kTriangleColumns =
    "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n";

TEST_F(Program, VerifiesSeveralLightsAndDepthCueing) {
  const std::string scene = write("effects.toml", kEffectsScene);
  for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                               {"--detail", "cycle"},
                                               {"--stall", "30", "--seed", "5"},
                                               {"--effects", "all"},
                                               {"--set", "specular_gate=off"}}) {
    // A small picture has few pixels to spread the triangles' setup over.
    std::vector<std::string> arguments = {scene, "--budget", "2000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const nlohmann::json result = verify(arguments);
    expect_agreement(result);
    const nlohmann::json& used = result["effects"]["used"];
    for (const char* effect : {"2 lights in passes", "depth cueing", "depth test", "colour"}) {
      EXPECT_EQ(std::count(used.begin(), used.end(), effect), 1) << effect << " of " << used;
    }
  }
}

TEST_F(Program, VerifyProvesAnErrorAndAccountsForEveryPixel) {
  const nlohmann::json result =
      verify({"torus", "--set", "setup_engine.max_error=1", "--set", "scene.image.width=128",
              "--set", "scene.image.height=128", "--budget", "1000"});
  expect_agreement(result);
  std::uint64_t pixels = 0, cycles = 0;
  for (const char* path :
       {"taylor", "six_point", "weighted", "focused", "subdivided", "exact_path", "refused"}) {
    pixels += result["ledger"][path].get<std::uint64_t>();
    cycles += result["ledger_cycles"][path].get<std::uint64_t>();
  }
  EXPECT_EQ(pixels, result["pixels"]);
  EXPECT_GT(cycles, result["cycles"]["setup"]);
  EXPECT_GT(result["ledger"]["exact_path"], 0);
  EXPECT_LE(result["max_error_lsb"], result["certified_error_lsb"]);
  EXPECT_LE(result["certified_error_lsb"], 1);
  const ProcessOutput told = run({"verify", "torus", "--set", "max_error=1"});
  EXPECT_NE(told.text.find("LSB proved for every pixel"), std::string::npos) << told.text;
  expect_refused({"verify", "torus", "--set", "max_error=0.3"}, "the least that can be had");
  // Without it nothing is proved, and all pixels are of the one fit.
  const nlohmann::json plain = verify({"sphere"});
  EXPECT_TRUE(plain["certified_error_lsb"].is_null());
  EXPECT_EQ(plain["ledger"]["weighted"], plain["pixels"]);
}

TEST_F(Program, VerifiesHardCases) {
  const ProcessOutput output = run({"verify", "--hard-cases", "table", "--out", folder_.string(),
                                    "--json", file("hard.json"), "--verbose"});
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("top_of_table"), std::string::npos) << output.text;
  for (const nlohmann::json& hard_case : json("hard.json")) {
    EXPECT_TRUE(hard_case["passed"]) << hard_case;
    EXPECT_GT(hard_case["guarded"], 0) << hard_case;
  }
  EXPECT_GT(std::filesystem::file_size(file("hard-cases.png")), 100U);
  const std::string page = read_whole_file(file("hard-cases.html"));
  EXPECT_NE(page.find("<h1>Hard cases</h1>"), std::string::npos);
  EXPECT_NE(page.find(" passed, 0 failed, 0 refused."), std::string::npos);
  // The cases are told of on demand, not above the graph.
  const std::string summary = page.substr(0, page.find("<main"));
  EXPECT_EQ(summary.find("negative-shininess"), std::string::npos) << summary;
  EXPECT_NE(page.find("table/negative-shininess: refused, as expected: negative-shininess.toml:"),
            std::string::npos);
  for (const std::string& text : {page, output.text, read_whole_file(file("hard.json"))}) {
    EXPECT_EQ(text.find(installation().hard_cases.string()), std::string::npos)
        << "where the program is installed";
  }
  expect_refused({"verify"}, "give scenes, or --hard-cases");
  expect_refused({"verify", "--hard-cases", "nowhere"}, "nowhere: no hard case");
  expect_refused({"verify", "--hard-cases", "--set", "anchor=span"}, "its scene and settings");
}

TEST_F(Program, LinesOfHardCasesHaveEqualColumnsAndCountInWords) {
  const std::string name = "control/table-between-spans-of-two-materials";
  const ProcessOutput output =
      run_for_answer("verify --hard-cases " + name + " channels/depth-cue-too-steep");
  const std::size_t second = output.text.find('\n') + 1;
  EXPECT_EQ(output.text.find("stalls: "), output.text.find("overflow: ") - second) << output.text;
  EXPECT_NE(output.text.find("overflow: 1 triangle; "), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("; 1 method, worst phong"), std::string::npos) << output.text;
}

TEST_F(Program, VerifyChecksTheErrorOfEveryPixel) {
  const ProcessOutput failed =
      run({"verify", "teapot", "--max-error", "0.7", "--json", file("r.json")});
  EXPECT_EQ(failed.status, 1) << failed.text;
  const nlohmann::json result = json("r.json");
  EXPECT_EQ(result["within_error"], false);
  EXPECT_EQ(result["worst_pixels"].size(), 10U);
  const nlohmann::json& worst = result["worst_pixels"][0];
  EXPECT_EQ(worst["error_lsb"], result["accuracy"]["max_lsb"]);
  EXPECT_EQ(worst["error_lsb"], result["max_error_lsb"]);
  EXPECT_NE(failed.text.find(fmt::format("triangle {}, x {}, y {}", worst["triangle"].get<int>(),
                                         worst["x"].get<int>(), worst["y"].get<int>())),
            std::string::npos)
      << failed.text;
  EXPECT_NE(failed.text.find("mostly " + worst["largest_part"].get<std::string>()),
            std::string::npos);
  EXPECT_EQ(run({"verify", "teapot", "--max-error", "1"}).status, 0);
  for (const char* bad : {"x", "-1", "nan", ""}) {
    const ProcessOutput refused = run({"verify", "teapot", "--max-error", bad});
    EXPECT_EQ(refused.status, 2) << bad << ": " << refused.text;
  }
}

TEST_F(Program, VerifyTellsOfPixelsThatAreFarOff) {
  const ProcessOutput output = run({"verify", "teapot", "--set", "depth_bits=8"});
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find(" pixels off by more than 2 LSB, at most 17"), std::string::npos)
      << output.text;
  EXPECT_NE(output.text.find("largest part: visibility"), std::string::npos) << output.text;
}

TEST_F(Program, VerifyTellsWhatTheSceneNeedsAndWhatThatSaves) {
  const ProcessOutput output =
      run({"verify", "sphere", "--effects", "both", "--verbose", "--json", file("r.json")});
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("hardware for the scene, with every effect"), std::string::npos)
      << output.text;
  const nlohmann::json effects = json("r.json")["effects"];
  const auto holds = [&effects](const char* list, const char* effect) {
    return std::count(effects[list].begin(), effects[list].end(), effect) == 1;
  };
  EXPECT_TRUE(holds("used", "diffuse light")) << effects;
  EXPECT_TRUE(holds("left_out", "depth cueing")) << effects;
  EXPECT_TRUE(holds("left_out", "colour")) << effects;
  const nlohmann::json &built = effects["built"], &everything = effects["everything"];
  EXPECT_EQ(everything["frame_mismatches"], 0);
  for (const char* less :
       {"setup_operations", "pixel_operations", "adders", "multipliers", "rom_bits"}) {
    EXPECT_LT(built[less], everything[less]) << less;
  }
  EXPECT_LE(built["frame_cycles"], everything["frame_cycles"]);
  EXPECT_LT(built["modules"].size(), everything["modules"].size());
  EXPECT_TRUE(built.contains("simulation_seconds"));
}

TEST_F(Program, VerifyBuildsEverythingWhereAskedTo) {
  const ProcessOutput output = run({"verify", "sphere", "--effects", "all", "--budget", "1000",
                                    "--verbose", "--json", file("r.json")});
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("everything is built and simulated"), std::string::npos)
      << output.text;
  const nlohmann::json all = json("r.json")["effects"];
  EXPECT_FALSE(all.contains("everything")) << "there is no more to compare it with";
  const nlohmann::json compared = verify({"sphere", "--effects", "both"})["effects"]["everything"];
  for (const char* same : {"frame_cycles", "setup_operations", "pixel_operations", "adders",
                           "multipliers", "rom_bits", "modules"}) {
    EXPECT_EQ(all["built"][same], compared[same]) << same;
  }
}

TEST_F(Program, SplitTrianglesAreReportedAndShadedAlikeInAllAccounts) {
  const nlohmann::json split = verify({"screen-triangles"});
  EXPECT_EQ(split["subdivision"]["triangles"], 6);
  EXPECT_EQ(split["subdivision"]["pieces"], 24);
  EXPECT_EQ(split["mismatches"]["model_rtl"], 0);
  const nlohmann::json whole = verify({"screen-triangles", "--set", "subdivide_degrees=0"});
  EXPECT_EQ(whole["subdivision"]["triangles"], 0);
  EXPECT_EQ(whole["triangles"], split["triangles"]);
  EXPECT_EQ(whole["pixels"], split["pixels"]);
  EXPECT_GT(whole["accuracy"]["max_lsb"], split["accuracy"]["max_lsb"]);
}

TEST_F(Program, VerifyWritesTheTimelineAndItsPicture) {
  const std::string timeline = file("t.v2.json");
  const ProcessOutput output = run({"verify", "sphere", "--timeline", timeline});
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("more     --verbose, " + timeline + ", " + file("t.v2.svg")),
            std::string::npos)
      << output.text;
  EXPECT_GT(json("t.v2.json")["traceEvents"].size(), 1000U);
  const std::string picture = read_whole_file(file("t.v2.svg"));
  EXPECT_NE(picture.find("sphere: limited by setup_engine"), std::string::npos);
}

TEST_F(Program, OverBudgetFails) {
  const ProcessOutput output = run({"verify", "sphere", "--budget", "1"});
  EXPECT_EQ(output.status, 1);
  EXPECT_NE(output.text.find("of 1 ns a pixel, OVER BUDGET"), std::string::npos) << output.text;
  const ProcessOutput two = run({"verify", "sphere", "mesh", "--budget", "6"});
  EXPECT_NE(two.text.find("of 6 ns a pixel, OVER BUDGET"), std::string::npos) << two.text;
  EXPECT_NE(two.text.find("1 of 2 passed"), std::string::npos) << two.text;
  EXPECT_NE(output.text.find("FAILED"), std::string::npos);
}

TEST_F(Program, CoefficientOverflowFailsAndIsCounted) {
  write("t.csv", kTriangleColumns +
                     "2,2,9,-0.9,-0.3,-0.3162,60,2,9,0.9,-0.3,-0.3162,30,60,2,0,0.95,-0.3122\n");
  const std::string scene = write("s.toml", R"([image]
width = 64
height = 64
[[light]]
type = "directional"
direction = [0.4, 0.5, 1]
[[object]]
triangles = "t.csv"
material = "m"
[material.m]
ambient = 0.1
diffuse = 0.8
specular = 0.5
shininess = 10
)");
  const nlohmann::json result = verify({scene, "--hardware", "paper-1k"}, 1);
  EXPECT_EQ(result["coefficient_overflows"], 1);
  EXPECT_EQ(result["mismatches"]["model_rtl"], 0);  // all wrap alike
}

TEST_F(Program, TheHashNamesTheConfiguration) {
  const auto hash = [this](std::vector<std::string> more) {
    more.insert(more.begin(), {"sphere", "--budget", "1000"});
    return verify(more)["configuration_hash"];
  };
  EXPECT_EQ(hash({}), hash({"--set", "rom_data_bits=12"}));
  EXPECT_NE(hash({}), hash({"--set", "queues.spans=9"}));
  EXPECT_NE(hash({}), hash({"--set", "technology=generic"}));
}

// Memory follows the image: 12 bytes a pixel, however many lights or triangles go over it.
TEST_F(Program, FiftyLightsOverALargeImageNeedNoMoreMemoryThanOne) {
  std::string text = "[image]\nwidth = 4096\nheight = 4096\n";
  for (int i = 0; i < 50; ++i) {
    text += fmt::format("[[light]]\ntype = \"directional\"\ndirection = [{}, 1, 5]\ncolor = 0.02\n",
                        i - 25);
  }
  write("t.csv", kTriangleColumns + "100,100,1,0.1,0,-1,140,100,1,-0.1,0,-1,120,140,1,0,0.1,-1\n");
  const std::string scene = write("lights.toml", text + "[[object]]\ntriangles = \"t.csv\"\n");
#ifdef __SANITIZE_ADDRESS__
  const std::string limit;  // the sanitizer's own addresses are beyond any
#else
  const std::string limit = "ulimit -v 600000; ";
#endif
  const ProcessOutput output = run_process(
      {"sh", "-c", limit + "exec " PHONGPIPE_PROGRAM " verify " + scene + " --budget 1e9"});
  EXPECT_EQ(output.status, 0) << output.text;
}

}  // namespace
}  // namespace phongpipe
