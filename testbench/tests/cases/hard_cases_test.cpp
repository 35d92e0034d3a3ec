// The corpus of hard cases: each holds in model, SystemC, RTL and every shading method, and each
// needs the guard that it names.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "model/scene/input_error.h"
#include "testbench/cases/guards.h"
#include "testbench/cases/named_scene.h"
#include "testbench/hardware/hardware.h"
#include "testbench/methods/hard_case_run.h"

namespace phongpipe {
namespace {

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, HoldAndNeedTheirGuard) {
  const HardCaseResult result = run_hard_case(GetParam(), {}, false);
  EXPECT_EQ(result.failure, "") << "breaks: " << GetParam().breaks;
  EXPECT_GT(result.guarded, 0U);
  EXPECT_TRUE(result.methods > 0 || !result.verification);
}

INSTANTIATE_TEST_SUITE_P(Corpus, HardCases, testing::ValuesIn(hard_cases()),
                         [](const testing::TestParamInfo<HardCase>& info) {
                           std::string name = info.param.name;
                           for (char& c : name) {
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           }
                           return name;
                         });

TEST(HardCaseFiles, AreMany) {
  EXPECT_GE(hard_cases().size(), 80U);
}

// Every guard is needed by some case.
TEST(HardCaseFiles, NeedEveryGuard) {
  std::set<std::string> used;
  for (const HardCase& hard_case : hard_cases()) used.insert(hard_case.guard);
  for (const Guard& guard : guards())
    EXPECT_EQ(used.count(std::string(guard.name)), 1U) << guard.name;
}

std::uint64_t count(const std::string& guard, const PreparedFrame& frame) {
  return find_guard(guard)->count({frame, run_model(frame.setup)});
}

// A square that faces the eye and the light: nothing clamps, saturates, overlaps or is cut.
constexpr const char* kEasy = R"(
[image]
width = 32
height = 32
[[light]]
type = "directional"
direction = [0, 0, 1]
[[object]]
triangle_rows = """
x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2
4.2,4.3,1,0.2,0.1,-1,28.1,4.6,1,0.3,0,-1,4.4,28.7,1,0.2,0,-1
"""
material = "shiny"
[material.shiny]
ambient = 0.1
diffuse = 0.5
specular = 0.3
shininess = 20
)";

std::string write_case(const std::string& head, const std::string& scene = kEasy) {
  std::string file = testing::TempDir() + fmt::format("/hard-case-{}.toml", getpid());
  std::ofstream(file) << head << scene;
  return file;
}

// So a count shows that a case needs its guard, not that the guard is there.
TEST(Guards, AreNotNeededByAnEasyScene) {
  const Hardware hardware = load_hardware("default", {});
  const PreparedFrame frame(load_named_scene(write_case("")), hardware.formats, hardware.setup);
  for (const Guard& guard : guards()) {
    if (guard.count == nullptr) continue;
    EXPECT_EQ(count(std::string(guard.name), frame), 0U) << guard.name;
  }
}

TEST(HardCase, ThatDoesNotNeedItsGuardFails) {
  for (const char* head : {"#! breaks=\"x\"\n#! must=\"y\"\n#! guard=\"saturation\"\n",
                           "#! breaks=\"x\"\n#! must=\"y\"\n#! guard=\"stalls\"\n",
                           "#! breaks=\"x\"\n#! must=\"y\"\n#! guard=\"settings\"\n#! "
                           "without=[\"anchor=triangle\"]\n"}) {
    const HardCase hard_case = load_hard_case(write_case(head), "easy");
    EXPECT_NE(run_hard_case(hard_case, {}, false).failure.find("does not need its guard"),
              std::string::npos)
        << head;
  }
}

TEST(HardCase, ThatIsNotRefusedOrIsRefusedOtherwiseFails) {
  const std::string head =
      "#! breaks=\"x\"\n#! must=\"y\"\n#! guard=\"refusal\"\n#! refused=\"zero\"\n";
  const auto failure = [&](const std::string& scene) {
    return run_hard_case(load_hard_case(write_case(head, scene), "easy"), {}, false).failure;
  };
  EXPECT_EQ(failure(kEasy), "is not refused");
  EXPECT_NE(failure("[image]\nwidth = 0\n").find("is refused with other words"), std::string::npos);
}

// Pages and lines show what came out, not what was looked for.
TEST(HardCase, ThatEndsAsItMustHasPassedAsARun) {
  const auto run_of = [](const std::string& guard, const std::string& scene) {
    const std::string head = "#! breaks=\"x\"\n#! must=\"y\"\n" + guard;
    return as_run(run_hard_case(load_hard_case(write_case(head, scene), "easy"), {}, false));
  };
  const std::string width = "#! guard=\"refusal\"\n#! refused=\"from 1\"\n";
  const RunResult refused = run_of(width, "[image]\nwidth = 0\n");
  EXPECT_EQ(refused.outcome, Outcome::passed);
  EXPECT_EQ(refused.message.rfind("refused, as expected: ", 0), 0U) << refused.message;
  EXPECT_NE(refused.message.find("width is 0, must be from 1 to"), std::string::npos)
      << refused.message;

  const RunResult not_refused = run_of(width, kEasy);
  EXPECT_EQ(not_refused.outcome, Outcome::failed);
  EXPECT_EQ(not_refused.message, "is not refused");

  for (const HardCase& hard_case : hard_cases()) {
    if (hard_case.name != "channels/depth-cue-too-steep") continue;
    const RunResult overflow = as_run(run_hard_case(hard_case, {}, false));
    EXPECT_EQ(overflow.outcome, Outcome::passed);
    EXPECT_EQ(overflow.message,
              "overflow, as expected: values of 1 triangle do not fit their registers");
    return;
  }
  FAIL() << "no such case";
}

TEST(HardCase, WhoseHeadIsWrongIsRefusedByLine) {
  const std::map<std::string, std::string> wrong = {
      {"#! breaks = \"x\"\n", "must"},
      {"#! breaks = \"x\"\n#! must = \"y\"\n#! guard = \"luck\"\n", "no guard is called 'luck'"},
      {"#! breaks = \"x\"\n#! must = \"y\"\n#! guard = \"refusal\"\n", "go together"},
      {"#! breaks = \"x\"\n#! must = \"y\"\n#! guard = \"settings\"\n", "go together"},
      {"#! breaks = \"x\"\n#! must = \"y\"\n#! guard = \"gate\"\n#! color = 1\n", "color"}};
  for (const auto& [head, part] : wrong) {
    try {
      load_hard_case(write_case(head), "wrong");
      ADD_FAILURE() << head;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("hard-case-"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace phongpipe
