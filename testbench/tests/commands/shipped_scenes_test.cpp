// Every shipped scene: no mismatch, and the error that is stated.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

// Largest errors against exact Phong shading, in LSB, measured and rounded up; `dominant` is the
// link of the chain whose own largest error is the largest. Mostly that is the output of each
// light's pass, which is rounded by ½ LSB, and by depth cueing once more; where highlights fall on
// coarse triangles, the series.
struct Shipped {
  const char* scene;
  double largest_error;
  const char* dominant;
};

void PrintTo(const Shipped& shipped, std::ostream* out) {
  *out << shipped.scene;
}

constexpr Shipped kShipped[] = {
    {"teapot", 0.95, "series"},
    {"pawn", 0.7, "output"},
    {"sphere", 0.6, "output"},
    {"torus", 0.6, "output"},
    {"two-planes", 0.2, "output"},
    {"screen-triangles", 1.7, "series"},
    {"mesh", 0.7, "output"},
    {"effects/ambient", 0, "output"},  // of 0.4, which is 102 LSB
    {"effects/depth-cue", 1.15, "output"},
    {"effects/diffuse", 0.55, "output"},
    {"effects/golden-sphere", 0.7, "output"},
    {"effects/local-viewer", 0.6, "output"},
    {"effects/nettle", 1.15, "series"},
    {"effects/point-light", 0.65, "output"},
    {"effects/reflection", 0.7, "output"},
    {"effects/spotlight", 1.1, "output"},   // two passes
    {"effects/two-lights", 1.1, "output"},  // the same
};

class ShippedScene : public Program, public ::testing::WithParamInterface<Shipped> {
 protected:
  nlohmann::json verify_scene(std::vector<std::string> more) const {
    more.insert(more.begin(), GetParam().scene);
    return verify(more);
  }
};

TEST_P(ShippedScene, PassesWithoutAMismatchInBothDetails) {
  for (const char* detail : {"span", "cycle"}) {
    const nlohmann::json result = verify_scene({"--detail", detail, "--effects", "both"});
    expect_agreement(result);
    EXPECT_EQ(result["effects"]["everything"]["frame_mismatches"], 0);
    EXPECT_GT(result["pixels"], 10000);
  }
}

TEST_P(ShippedScene, PassesUnderRandomBackPressureWithEqualCycles) {
  expect_agreement(verify_scene({"--stall", "25", "--seed", "11"}));
}

TEST_P(ShippedScene, IsAsNearToExactPhongShadingAsStated) {
  const nlohmann::json result = verify_scene({});
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

}  // namespace
}  // namespace phongpipe
