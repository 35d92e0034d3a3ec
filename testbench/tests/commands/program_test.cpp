// phongpipe from the command line: what it writes, what it says, how it exits.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/files/text_file.h"
#include "testbench/cosim/metrics.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class Program : public ::testing::Test {
 protected:
  Program() : folder_(fs::path(::testing::TempDir()) / fmt::format("phongpipe-{}", getpid())) {
    fs::create_directories(folder_);
    // Not the user's; and kept, so that only the first run builds the RTL.
    setenv("XDG_CACHE_HOME", PHONGPIPE_RTL_CACHE, 1);
  }
  ~Program() override { fs::remove_all(folder_); }

  ProcessOutput run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), PHONGPIPE_PROGRAM);
    return run_process(arguments);
  }
  // Standard output alone: a sanitizer may say something of its own.
  static ProcessOutput run_for_answer(const std::string& arguments) {
    return run_process({"sh", "-c", PHONGPIPE_PROGRAM " " + arguments + " 2>/dev/null"});
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return file(name);
  }
  // Bad input: one line that holds `message`, status 2, and nothing written.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& message) const {
    const auto files = [this] {
      return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    };
    const auto before = files();
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 2) << output.text;
    EXPECT_NE(output.text.find(message), std::string::npos) << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
    EXPECT_EQ(files(), before) << "something was left behind";
  }
  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(read_whole_file(file(name)));
  }

  fs::path folder_;
};

// Largest errors against exact Phong shading, in LSB, measured and rounded up; `dominant` is the
// link of the chain whose own largest error is the largest. Mostly that is the ROM, of 1k words of
// 8 bits: rounding the cosine to an address is worth 255·Ks·n/2048 LSB where a highlight is
// brightest, rounding the word ½ LSB. The output of each light's pass is rounded by ½ LSB, and by
// depth cueing once more.
struct Shipped {
  const char* scene;
  double largest_error;
  const char* dominant;
};

void PrintTo(const Shipped& shipped, std::ostream* out) {
  *out << shipped.scene;
}

constexpr Shipped kShipped[] = {
    {"teapot", 1.6, "rom"},
    {"pawn", 1.65, "rom"},
    {"sphere", 1.65, "rom"},
    {"torus", 2.15, "rom"},
    {"two-planes", 0.85, "rom"},
    {"screen-triangles", 1.95, "series"},
    {"mesh", 1.7, "rom"},
    {"effects/ambient", 0, "output"},        // of 0.4, which is 102 LSB
    {"effects/depth-cue", 2.8, "rom"},       // exponents up to 40
    {"effects/diffuse", 0.55, "output"},     // no ROM
    {"effects/golden-sphere", 2.45, "rom"},  // a specular colour of 1
    {"effects/local-viewer", 1.5, "rom"},
    {"effects/nettle", 1.8, "rom"},
    {"effects/point-light", 1.7, "rom"},
    {"effects/reflection", 1.35, "rom"},
    {"effects/spotlight", 2.3, "rom"},    // two passes
    {"effects/two-lights", 2.35, "rom"},  // the same, with exponents of 30
};

class ShippedScene : public Program, public ::testing::WithParamInterface<Shipped> {
 protected:
  nlohmann::json verify(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"verify", GetParam().scene, "--json", file("r.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0) << output.text;
    return json("r.json");
  }
  static void expect_agreement(const nlohmann::json& result) {
    EXPECT_EQ(result["mismatches"]["model_rtl"], 0);
    EXPECT_EQ(result["mismatches"]["model_systemc"], 0);
    EXPECT_EQ(result["mismatches"]["frame_rtl"], 0);
    EXPECT_EQ(result["mismatches"]["frame_systemc"], 0);
    EXPECT_EQ(result["cycles"]["difference"], 0);
    EXPECT_EQ(result["coefficient_overflows"], 0);
    EXPECT_TRUE(result["passed"]);
  }
};

TEST_P(ShippedScene, PassesWithoutAMismatchInBothDetails) {
  for (const char* detail : {"span", "cycle"}) {
    const nlohmann::json result = verify({"--detail", detail, "--effects", "both"});
    expect_agreement(result);
    EXPECT_EQ(result["effects"]["everything"]["frame_mismatches"], 0);
    EXPECT_GT(result["pixels"], 10000);
  }
}

TEST_P(ShippedScene, PassesUnderRandomBackPressureWithEqualCycles) {
  expect_agreement(verify({"--stall", "25", "--seed", "11"}));
}

TEST_P(ShippedScene, IsAsNearToExactPhongShadingAsStated) {
  const nlohmann::json result = verify({});
  EXPECT_LE(result["accuracy"]["max_lsb"], GetParam().largest_error);
  const nlohmann::json& split = result["accuracy_split"];
  for (const auto& [link, errors] : split.items()) {
    EXPECT_LE(errors["max_lsb"], split[GetParam().dominant]["max_lsb"]) << link << " dominates";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, ::testing::ValuesIn(kShipped),
                         [](const auto& parameter) {
                           std::string name = parameter.param.scene;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return c == '-' || c == '/'; }, '_');
                           return name;
                         });

// So that none is forgotten above.
TEST_F(Program, EverySceneThatIsShippedIsTested) {
  const fs::path folder = PHONGPIPE_SCENES;
  for (const char* part : {"", "effects"}) {
    for (const auto& entry : fs::directory_iterator(folder / part)) {
      if (entry.path().extension() != ".toml") continue;
      const std::string name = (fs::path(part) / entry.path().stem()).string();
      EXPECT_TRUE(std::any_of(std::begin(kShipped), std::end(kShipped),
                              [&name](const Shipped& shipped) { return shipped.scene == name; }))
          << name;
    }
  }
}

TEST_F(Program, VerifyWritesEveryKeyAndThreePictures) {
  ASSERT_EQ(run({"verify", "sphere", "--effects", "both", "--out", folder_.string(), "--json",
                 file("r.json")})
                .status,
            0);
  const nlohmann::json result = json("r.json");
  for (const char* key : {"/scene",
                          "/configuration",
                          "/configuration_hash",
                          "/triangles",
                          "/pixels",
                          "/subdivision/triangles",
                          "/subdivision/pieces",
                          "/mismatches/model_rtl",
                          "/mismatches/model_systemc",
                          "/cycles/frame",
                          "/cycles/datapath_rtl",
                          "/cycles/datapath_systemc",
                          "/cycles/difference",
                          "/clock_ns",
                          "/clock_source",
                          "/ns_per_pixel/datapath",
                          "/ns_per_pixel/frame",
                          "/budget_ns",
                          "/effects/used",
                          "/effects/left_out",
                          "/effects/built",
                          "/effects/everything",
                          "/within_budget",
                          "/detail",
                          "/stall_percent",
                          "/seed",
                          "/limited_by",
                          "/implementations/rtl/failure",
                          "/implementations/rtl/first_divergence",
                          "/implementations/systemc/first_divergence",
                          "/accuracy/max_lsb",
                          "/accuracy/rms_lsb",
                          "/accuracy/psnr_db",
                          "/accuracy/over_half",
                          "/accuracy/over_one",
                          "/accuracy/over_two",
                          "/accuracy_split",
                          "/passed"}) {
    EXPECT_TRUE(result.contains(nlohmann::json::json_pointer(key))) << key;
  }
  for (const char* picture : {"sphere-result.png", "sphere-exact.png", "sphere-error.png"}) {
    EXPECT_EQ(read_whole_file(file(picture)).substr(1, 3), "PNG") << picture;
  }
}

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

TEST_F(Program, VerifiesSeveralLightsAndDepthCueing) {
  const std::string scene = write("effects.toml", kEffectsScene);
  for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                               {"--detail", "cycle"},
                                               {"--stall", "30", "--seed", "5"},
                                               {"--effects", "all"},
                                               {"--set", "specular_gate=off"}}) {
    // A small picture has few pixels to spread the triangles' setup over.
    std::vector<std::string> arguments = {"verify", scene,    "--budget",
                                          "2000",   "--json", file("r.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0) << output.text;
    const nlohmann::json result = json("r.json");
    EXPECT_EQ(result["mismatches"]["model_rtl"], 0);
    EXPECT_EQ(result["mismatches"]["model_systemc"], 0);
    EXPECT_EQ(result["cycles"]["difference"], 0);
    const nlohmann::json& used = result["effects"]["used"];
    for (const char* effect : {"2 lights in passes", "depth cueing", "depth test", "colour"}) {
      EXPECT_EQ(std::count(used.begin(), used.end(), effect), 1) << effect << " of " << used;
    }
  }
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
  ASSERT_EQ(run({"verify", "sphere", "--effects", "both", "--json", file("r.json")}).status, 0);
  const nlohmann::json compared = json("r.json")["effects"]["everything"];
  for (const char* same : {"frame_cycles", "setup_operations", "pixel_operations", "adders",
                           "multipliers", "rom_bits", "modules"}) {
    EXPECT_EQ(all["built"][same], compared[same]) << same;
  }
}

TEST_F(Program, JsonAloneGoesToStandardOutput) {
  const ProcessOutput output =
      run_process({"sh", "-c", PHONGPIPE_PROGRAM " verify sphere --json - 2>/dev/null"});
  EXPECT_TRUE(nlohmann::json::accept(output.text)) << output.text;
}

TEST_F(Program, SeveralScenesAreALineEachAndAnArray) {
  const ProcessOutput output = run_for_answer("verify sphere two-planes --json " + file("r.json"));
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 3) << output.text;
  EXPECT_EQ(output.text.rfind("PASSED sphere", 0), 0U) << output.text;
  EXPECT_NE(output.text.find("2 of 2 passed\n"), std::string::npos) << output.text;
  EXPECT_EQ(json("r.json").size(), 2U);
}

TEST_F(Program, TheAnswerIsFiveLines) {
  const ProcessOutput output = run_for_answer("verify sphere");
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 5) << output.text;
  for (const char* part : {"PASSED sphere  256×256, 42,464 pixels, hardware default ",
                           "\n  same     model = SystemC = RTL, every pixel and every cycle (",
                           "\n  time     29.56 of 100 ns a pixel; datapath 8.68; limited by setup",
                           "\n  error    at most 1.61 LSB", "\n  more     --verbose"}) {
    EXPECT_NE(output.text.find(part), std::string::npos) << part << " in\n" << output.text;
  }
}

TEST_F(Program, VerboseTellsEverySettingAndMetric) {
  const ProcessOutput output = run({"verify", "sphere", "--verbose"});
  ASSERT_EQ(output.status, 0) << output.text;
  for (const Setting<Hardware>& setting : hardware_settings()) {
    EXPECT_NE(output.text.find(fmt::format("{} ", setting.key)), std::string::npos)
        << setting.name();
  }
  for (const Metric& metric : metrics()) {
    EXPECT_NE(output.text.find(fmt::format("\n  {} ", metric.name)), std::string::npos)
        << metric.name;
  }
}

// A scene that turns out to be no picture keeps nobody from the results of the others.
TEST_F(Program, EverySceneHasAResultWhereOneIsRefused) {
  std::string text = read_whole_file(fs::path(PHONGPIPE_SCENES) / "sphere.toml");
  const std::string object = "primitive = \"sphere\"\n";
  text.insert(text.find(object) + object.size(), "translate = [1000, 0, 0]\n");
  const std::string away = write("away.toml", text);
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
  const std::string text = read_whole_file(fs::path(PHONGPIPE_SCENES) / "two-planes.toml");
  const std::string first = write("planes.toml", text), second = write("other/planes.toml", text);
  ASSERT_EQ(run({"verify", first, second, "--out", file("pictures")}).status, 0);
  for (const char* picture : {"planes-result.png", "planes-2-result.png"}) {
    EXPECT_TRUE(fs::exists(folder_ / "pictures" / picture)) << picture;
  }
}

TEST_F(Program, OutputsThatCannotBeWrittenAreRefusedBeforeTheWork) {
  expect_refused({"verify", "sphere", "--json", "/nosuch/r.json"}, "/nosuch/r.json");
  expect_refused({"verify", "sphere", "--out", "/dev/null/pictures"}, "/dev/null/pictures");
  expect_refused({"render", "sphere", "-o", "/nosuch/a.png"}, "/nosuch/a.png");
  expect_refused({"compare", "sphere", "--csv", folder_.string()}, folder_.string());
  const ProcessOutput full =
      run_process({"sh", "-c", PHONGPIPE_PROGRAM " verify sphere > /dev/full"});
  EXPECT_EQ(full.status, 3) << full.text;
  EXPECT_NE(full.text.find("No space left on device"), std::string::npos) << full.text;
}

// Memory follows the image: 12 bytes a pixel, however many lights or triangles go over it.
TEST_F(Program, FiftyLightsOverALargeImageNeedNoMoreMemoryThanOne) {
  std::string text = "[image]\nwidth = 4096\nheight = 4096\n";
  for (int i = 0; i < 50; ++i) {
    text += fmt::format("[[light]]\ntype = \"directional\"\ndirection = [{}, 1, 5]\ncolor = 0.02\n",
                        i - 25);
  }
  write("t.csv",
        "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n"
        "100,100,1,0.1,0,-1,140,100,1,-0.1,0,-1,120,140,1,0,0.1,-1\n");
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

TEST_F(Program, FailedToolsAreStatusThree) {
  fs::create_directories(folder_ / "hw");
  write("hw/pixel_datapath.sv", "module pixel_datapath; endmodul\n");
  const ProcessOutput output = run({"verify", "sphere", "--rtl", file("hw")});
  EXPECT_EQ(output.status, 3) << output.text;
  EXPECT_NE(output.text.find("building the RTL failed: verilator said: %Error"), std::string::npos)
      << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
}

TEST_F(Program, HelpSettingsExplainsEachWithThePresetsValue) {
  const Hardware preset = load_hardware("default", {});
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help-settings"}, {"verify", "--help-settings"}}) {
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0);
    for (const Setting<Hardware>& setting : hardware_settings()) {
      const std::string shown = fmt::format("  {} = {} ", setting.key, setting.value(preset));
      EXPECT_NE(output.text.find(shown), std::string::npos) << shown;
      EXPECT_NE(output.text.find(setting.meaning), std::string::npos) << setting.name();
    }
  }
}

TEST_F(Program, OverBudgetFails) {
  const ProcessOutput output = run({"verify", "sphere", "--budget", "1"});
  EXPECT_EQ(output.status, 1);
  EXPECT_NE(output.text.find("of 1 ns a pixel, OVER BUDGET"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("FAILED"), std::string::npos);
}

TEST_F(Program, TheHashNamesTheConfiguration) {
  const auto hash = [this](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"verify",       "sphere",   "--json",
                                          file("r.json"), "--budget", "1000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).status, 0);
    return json("r.json")["configuration_hash"];
  };
  EXPECT_EQ(hash({}), hash({"--set", "rom_data_bits=8"}));
  EXPECT_NE(hash({}), hash({"--set", "queues.spans=9"}));
  EXPECT_NE(hash({}), hash({"--set", "technology=generic"}));
}

TEST_F(Program, CoefficientOverflowFailsAndIsCounted) {
  write("t.csv",
        "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n"
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
  const ProcessOutput output =
      run({"verify", scene, "--hardware", "paper-1k", "--json", file("r.json")});
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_EQ(json("r.json")["coefficient_overflows"], 1);
  EXPECT_EQ(json("r.json")["mismatches"]["model_rtl"], 0);  // all wrap alike
}

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
  const std::string paper = picture({"--hardware", "paper-1k"});
  EXPECT_EQ(paper, picture({"--method", "taylor", "--arithmetic", "fixed"}));
  EXPECT_NE(own, paper);
  EXPECT_NE(paper, picture({"--method", "taylor"}));
}

TEST_F(Program, PhongRendersWhatThePipelineRefuses) {
  std::string text = read_whole_file(fs::path(PHONGPIPE_SCENES) / "sphere.toml");
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

TEST_F(Program, CompareWritesAPageTablesAndCurves) {
  const ProcessOutput output = run({"compare", "sphere", "--out", folder_.string(), "--json",
                                    file("c.json"), "--csv", file("c.csv")});
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(read_whole_file(file("sphere-methods.html")).find("sphere-gouraud-error.png"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(file("sphere-gouraud-error.png")));
  EXPECT_EQ(json("c.json")[0]["methods"][0]["method"], "flat");
  ASSERT_EQ(run({"compare", "--curve", "size", "--out", folder_.string()}).status, 0);
  EXPECT_EQ(read_whole_file(file("size.svg")).substr(0, 4), "<svg");
  expect_refused({"compare"}, "nothing to compare");
  expect_refused({"compare", "--curve", "colour"}, "curvature");
}

TEST_F(Program, ComparedJsonAloneGoesToStandardOutput) {
  const ProcessOutput output =
      run_process({"sh", "-c", PHONGPIPE_PROGRAM " compare sphere --json - 2>/dev/null"});
  EXPECT_TRUE(nlohmann::json::accept(output.text)) << output.text;
}

TEST_F(Program, SplitTrianglesAreReportedAndShadedAlikeInAllAccounts) {
  const ProcessOutput output = run({"verify", "screen-triangles", "--json", file("r.json")});
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(json("r.json")["subdivision"]["triangles"], 6);
  EXPECT_EQ(json("r.json")["subdivision"]["pieces"], 24);
  EXPECT_EQ(json("r.json")["mismatches"]["model_rtl"], 0);
  ASSERT_EQ(run({"verify", "screen-triangles", "--set", "subdivide_degrees=0", "--json",
                 file("whole.json")})
                .status,
            0);
  EXPECT_EQ(json("whole.json")["subdivision"]["triangles"], 0);
  EXPECT_EQ(json("whole.json")["triangles"], json("r.json")["triangles"]);
  EXPECT_EQ(json("whole.json")["pixels"], json("r.json")["pixels"]);
  EXPECT_GT(json("whole.json")["accuracy"]["max_lsb"], json("r.json")["accuracy"]["max_lsb"]);
}

TEST_F(Program, RenderTakesAnyMethodAndRefusesByName) {
  EXPECT_EQ(run({"render", "teapot", "--method", "gouraud", "-o", file("g.png")}).status, 0);
  expect_refused({"render", "torus", "--method", "otm", "-o", file("o.png")},
                 "otm cannot render it");
  expect_refused({"render", "torus", "--method", "goraud", "-o", file("o.png")},
                 "did you mean gouraud");
}

TEST_F(Program, AnEmptyPictureIsNoPass) {
  std::string text = read_whole_file(fs::path(PHONGPIPE_SCENES) / "sphere.toml");
  const std::string object = "primitive = \"sphere\"\n";
  text.insert(text.find(object) + object.size(), "translate = [1000, 0, 0]\n");
  expect_refused({"verify", write("away.toml", text)}, "nothing of the scene covers a pixel");
}

TEST_F(Program, BadUsageIsOneLineAndTwo) {
  expect_refused({}, "which command? There are verify, render, compare");
  expect_refused({"frob"}, "frob: no such command; there are verify, render, compare");
  expect_refused({"verfy", "sphere"}, "did you mean verify?");
  expect_refused({"verify"}, "scenes is required");
  expect_refused({"verify", "nosuch.toml"},
                 "nosuch.toml: no such file or scene; there are the scenes mesh, pawn,");
  expect_refused({"verify", "sphere", "--hardware", "nosuch"}, "paper-1k, paper-8k");
  expect_refused({"verify", "sphere", "--set", "rom_adress_bits=9"},
                 "did you mean rom_address_bits");
  expect_refused({"verify", "sphere", "--set", "rom_address_bits=99"}, "6 to 13");
  expect_refused({"verify", "sphere", "--set", "rom_address_bits=ten"}, "whole number");
  expect_refused({"verify", "sphere", "--set", "anchor=pixel"}, "one of triangle, span");
  expect_refused({"verify", "sphere", "--set", "technology=nosuch"}, "generic, ice40-hx8k");
  for (const char* budget : {"-3", "0", "nan", "inf"}) {
    expect_refused({"verify", "sphere", "--budget", budget}, "is not a number above 0");
  }
  expect_refused({"verify", "sphere", "--stall", "101"}, "--stall");
  expect_refused({"verify", "sphere", "--rtl", "/nosuch"}, "--rtl");
  expect_refused({"verify", "sphere", "--effects", "nonsense"},
                 "--effects: nonsense is none of scene|all|both");
  expect_refused({"render", "sphere", "-o", file("a.png"), "--power", "lyon-4"},
                 "use --power with --arithmetic real");
  expect_refused({"render", "sphere"}, "nothing to write");
  expect_refused({"render", "sphere", "-o", file("a.jpg")}, ".png or .pfm");
  expect_refused({"verify", "efects/ambient"}, "did you mean effects/ambient?");
  expect_refused(
      {"render", "sphere", "--method", "phong", "--arithmetic", "fixed", "-o", file("a.png")},
      "no fixed-point form");
}

TEST_F(Program, BadFilesAreNamedWithTheirLine) {
  expect_refused({"verify", write("broken.toml", "[image\n")}, "broken.toml:1:");
  expect_refused({"verify", write("zero.toml", "[image]\nwidth = 0\nheight = 4\n")},
                 "zero.toml:2:");
  const std::string hardware = write("h.toml", "[datapath]\nrom_data_bits = 3\n");
  expect_refused({"verify", "sphere", "--hardware", hardware}, "h.toml:2:");
  const std::string unknown = write("u.toml", "[datapath]\nrom_bits = 8\n");
  expect_refused({"verify", "sphere", "--hardware", unknown}, "u.toml:2:");
}

TEST_F(Program, HelpHasAnExampleAtEachLevel) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"verify", "--help"},
                                                    {"render", "--help"},
                                                    {"compare", "--help"}}) {
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0);
    EXPECT_NE(output.text.find("Example: phongpipe"), std::string::npos) << output.text;
    for (const char* jargon : {"FLOAT:", "DIR:", "POSITIVE", " INT", "UINT"}) {
      EXPECT_EQ(output.text.find(jargon), std::string::npos) << output.text;
    }
  }
}

TEST_F(Program, NoColourAndNoProgressInAPipe) {
  const ProcessOutput output = run({"verify", "sphere"});
  EXPECT_EQ(output.text.find('\033'), std::string::npos);
  EXPECT_EQ(output.text.find('\r'), std::string::npos);
}

}  // namespace
}  // namespace phongpipe
