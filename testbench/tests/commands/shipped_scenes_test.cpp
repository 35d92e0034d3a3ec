// Every shipped scene: no mismatch, and the error that is stated.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

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
