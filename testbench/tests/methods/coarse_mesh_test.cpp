// What the default's quadratics are worth where the series matters: on coarse meshes, diffuse light
// and highlights by themselves, as `compare` measures them.
#include <gtest/gtest.h>

#include "model/files/scene_file.h"
#include "testbench/methods/comparison.h"
#include "testbench/tests/methods/result_of.h"

namespace phongpipe {
namespace {

class CoarseMesh : public ::testing::TestWithParam<const char*> {
 protected:
  static Comparison compare_with(const std::vector<std::string>& overrides) {
    return compare(load_scene(std::string(PHONGPIPE_SCENES) + "/coarse/" + GetParam() + ".toml"),
                   load_hardware("default", overrides), [](const std::string&) {});
  }
  static bool is_diffuse() {
    return std::string_view(GetParam()).find("diffuse") != std::string_view::npos;
  }
};

TEST_P(CoarseMesh, TheDefaultsErrorIsAFractionOfTaylorsAtEqualCostAPixel) {
  const Comparison comparison = compare_with({});
  const auto fit = static_cast<std::size_t>(comparison.hardware.setup.series_fit);
  const MethodResult& chosen = result_of(comparison, series_fit_names()[fit]);
  const MethodResult& taylor = result_of(comparison, "taylor");
  EXPECT_NE(chosen.note.find("the series of hardware default"), std::string::npos);
  EXPECT_EQ(chosen.costs.pixel, taylor.costs.pixel);
  EXPECT_LE(chosen.error.largest_lsb, (is_diffuse() ? 0.25 : 0.5) * taylor.error.largest_lsb);
}

TEST_P(CoarseMesh, NoFitIsBetterThanTheLimit) {
  const Comparison comparison = compare_with({});
  const double limit = result_of(comparison, "best").error.largest_lsb;
  for (const char* name : {"six-point", "weighted", "focused"}) {
    EXPECT_GE(result_of(comparison, name).error.largest_lsb, 0.98 * limit) << name;
  }
}

TEST_P(CoarseMesh, PiecesPayForTheirSetup) {
  const Comparison split = compare_with({}), whole = compare_with({"subdivide_degrees=0"});
  EXPECT_EQ(whole.split, 0U);
  EXPECT_EQ(result_of(split, "taylor").clocks_per_pixel,
            result_of(whole, "taylor").clocks_per_pixel);
  const auto clocks = [](const Comparison& c) { return result_of(c, "weighted").clocks_per_pixel; };
  if (split.split > 0) {
    EXPECT_GT(clocks(split), clocks(whole));
  } else {
    EXPECT_EQ(clocks(split), clocks(whole));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CoarseMesh,
                         ::testing::Values("pawn-diffuse", "pawn-power-20", "pawn-power-164",
                                           "teapot-diffuse", "teapot-power-20", "teapot-power-164",
                                           "sphere-diffuse", "sphere-power-20", "sphere-power-164"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace phongpipe
