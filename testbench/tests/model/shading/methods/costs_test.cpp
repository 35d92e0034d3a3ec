// The operations that the methods' own code executes, against what the sources claim.
#include <gtest/gtest.h>

#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

struct Row {
  const char* method;
  Parts parts;
  OperationCounts pixel;  // add, multiply, 1/√, divide, √, read
  bool combined;          // power and sum included
};

// The table of the sources, row by row; a "+1 sub" of Hast et al. is an addition here.
const std::vector<Row>& rows() {
  constexpr Parts kDiffuse = Parts::diffuse, kFull = Parts::full;
  static const std::vector<Row> table = {
      {"gouraud", kDiffuse, {1, 0, 0, 0, 0, 0}, false},
      {"gouraud", kFull, {1, 0, 0, 0, 0, 0}, true},
      {"phong", kDiffuse, {7, 6, 0, 1, 1, 0}, false},
      {"duff", kDiffuse, {3, 0, 0, 1, 1, 0}, false},
      {"taylor", kDiffuse, {2, 0, 0, 0, 0, 0}, false},
      {"taylor", kFull, {5, 0, 0, 0, 0, 1}, true},
      {"taylor-local", kFull, {5, 0, 0, 0, 0, 1}, true},
      {"otm", kDiffuse, {1, 0, 0, 0, 0, 1}, false},
      {"otm", kFull, {1, 0, 0, 0, 0, 1}, true},
      {"hybrid", kFull, {5, 0, 0, 1, 0, 0}, false},
      {"reflection", kDiffuse, {4, 0, 0, 1, 0, 0}, false},
      {"duff-blinn", kFull, {4, 2, 0, 1, 1, 0}, false},
      {"duff-eq17", kFull, {5, 0, 0, 2, 1, 0}, false},
      {"duff-eq33", kFull, {4 + 1, 1, 0, 2, 1, 0}, false},
      {"duff-eq34", kFull, {4 + 1, 3, 0, 1, 1, 0}, false},
      {"reflection-blinn", kFull, {6, 2, 0, 1, 0, 0}, false},
      {"reflection-hybrid", kFull, {8, 0, 0, 2, 0, 0}, false},
      {"reflection-eq34", kFull, {6 + 1, 3, 0, 1, 0, 0}, false},
  };
  return table;
}

TEST(ShadingCosts, PixelsCostWhatTheSourcesClaim) {
  for (const Row& row : rows()) {
    const MethodCosts costs = find_shading_method(row.method)->costs(row.parts, PowerKind::table);
    EXPECT_EQ(row.combined ? costs.pixel + costs.combine : costs.pixel, row.pixel) << row.method;
  }
}

TEST(ShadingCosts, TheRegistryQuotesTheSameClaims) {
  for (const ShadingMethod& method : shading_methods()) {
    for (const Claim& claim : method.claims) {
      const MethodCosts costs = method.costs(claim.parts, PowerKind::table);
      EXPECT_EQ(claim.combined ? costs.pixel + costs.combine : costs.pixel, claim.pixel)
          << method.name << ", " << claim.where;
    }
  }
}

TEST(ShadingCosts, MethodsThatNoSourceCounts) {
  const auto full = [](const char* name) {
    return find_shading_method(name)->costs(Parts::full, PowerKind::table).pixel;
  };
  EXPECT_EQ(full("flat"), OperationCounts());
  EXPECT_EQ(full("phong"), (OperationCounts{9, 9, 0, 2, 1, 0}));
  EXPECT_EQ(full("duff"), (OperationCounts{4, 0, 0, 2, 1, 0}));
  EXPECT_EQ(full("duff-table"), (OperationCounts{4, 2, 0, 0, 0, 1}));
  EXPECT_EQ(full("otm-halfway"), (OperationCounts{2, 0, 0, 0, 0, 2}));
  EXPECT_EQ(full("reflection"), (OperationCounts{6, 0, 0, 2, 0, 0}));
  EXPECT_EQ(full("point-reflection"), (OperationCounts{13, 5, 0, 2, 0, 0}));
  EXPECT_EQ(full("spot-reflection"), (OperationCounts{15, 6, 0, 2, 0, 0}));
  EXPECT_EQ(full("viewpoint-reflection"), (OperationCounts{13, 5, 0, 2, 0, 0}));
}

// Each vector that varies costs 3 additions for its step, 2 and 6 multiplications, a root and a
// division for its length.
TEST(ShadingCosts, PhongPaysForWhatVaries) {
  Scene scene;
  scene.lights.resize(1);
  const auto pixel = [&](Parts parts) { return phong_costs(scene, parts, PowerKind::table).pixel; };
  EXPECT_EQ(pixel(Parts::diffuse), (OperationCounts{7, 6, 0, 1, 1, 0}));
  scene.shading.highlight = Highlight::reflection;
  EXPECT_EQ(pixel(Parts::full), (OperationCounts{3 + 6 + 1, 12 + 1, 0, 1, 1, 0}));
  scene.lights[0].type = LightType::point;
  EXPECT_EQ(pixel(Parts::diffuse), (OperationCounts{5 + 5 + 2, 6 + 6 + 3, 0, 2, 2, 0}));
  scene.shading.viewer = Viewer::local;
  EXPECT_EQ(pixel(Parts::diffuse), (OperationCounts{5 + 5 + 2, 6 + 6 + 3, 0, 2, 2, 0}));
  EXPECT_EQ(pixel(Parts::full), (OperationCounts{15 + 6 + 1, 18 + 9 + 1, 0, 3, 3, 0}));
}

TEST(ShadingCosts, PowersCombineAtTheirOwnCost) {
  const auto combine = [](PowerKind power) {
    return find_shading_method("duff")->costs(Parts::full, power).combine;
  };
  EXPECT_EQ(combine(PowerKind::table), (OperationCounts{1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(combine(PowerKind::schlick), (OperationCounts{2, 1, 0, 1, 0, 0}));
  EXPECT_EQ(combine(PowerKind::lyon4), (OperationCounts{2, 3, 0, 0, 0, 0}));
  EXPECT_EQ(combine(PowerKind::lyon8), (OperationCounts{2, 4, 0, 0, 0, 0}));
  EXPECT_EQ(combine(PowerKind::lyon16), (OperationCounts{2, 5, 0, 0, 0, 0}));
}

// Set-up is dear where a pixel is cheap: the break-even polygon is found from these.
TEST(ShadingCosts, SeriesNeedMoreSetUpThanTheQuotient) {
  const auto triangle = [](const char* name) {
    const OperationCounts c =
        find_shading_method(name)->costs(Parts::full, PowerKind::table).triangle;
    return c.add + c.multiply + 10 * c.rsqrt;  // the paper's assumptions
  };
  EXPECT_LT(triangle("flat"), triangle("gouraud"));
  EXPECT_LT(triangle("duff"), triangle("taylor"));
  EXPECT_LT(triangle("taylor"), triangle("taylor-local"));
}

}  // namespace
}  // namespace phongpipe
