// The Pareto front against its definition, over random points with many ties.
#include "testbench/campaign/pareto.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "testbench/system/random.h"

namespace phongpipe {
namespace {

using Points = std::vector<std::optional<ParetoPoint>>;

TEST(Pareto, EqualPointsStandOnTheFrontTogether) {
  const Points points = {ParetoPoint{2, 1}, ParetoPoint{1, 2}, std::nullopt,
                         ParetoPoint{1, 2}, ParetoPoint{2, 2}, ParetoPoint{1, 3}};
  EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 3, 0}));
  EXPECT_TRUE(pareto_front({}).empty());
  EXPECT_TRUE(pareto_front({std::nullopt}).empty());
}

TEST(Pareto, NothingBeatsAPointOfTheFrontAndSomethingEveryOther) {
  Random random(20261129);
  for (int round = 0; round < 200; ++round) {
    Points points(static_cast<std::size_t>(random.integer(1, 40)));
    for (auto& point : points) {
      if (random.integer(0, 9) == 0) continue;
      point = ParetoPoint{static_cast<double>(random.integer(0, 6)),
                          static_cast<double>(random.integer(0, 6))};
    }
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i]) continue;
      const bool beaten = std::any_of(points.begin(), points.end(), [&](const auto& other) {
        return other && other->a <= points[i]->a && other->b <= points[i]->b &&
               (other->a < points[i]->a || other->b < points[i]->b);
      });
      if (!beaten) expected.push_back(i);
    }
    std::vector<std::size_t> front = pareto_front(points);
    std::sort(front.begin(), front.end());
    EXPECT_EQ(front, expected) << "round " << round;
  }
}

// Runs of another scene, or of the same with other contents, are no competition.
TEST(Pareto, EveryScenesContentHasAFrontOfItsOwn) {
  ResultTable table;
  table.columns = {"scene",   "scene_hash",         "scene.light.0.color",
                   "outcome", "frame_ns_per_pixel", "max_lsb"};
  const auto add = [&](const char* scene, const char* light, const char* outcome, double time,
                       double error) {
    table.rows.push_back({std::string(scene), std::string(scene) + light, std::string(light),
                          std::string(outcome), MetricValue(time), MetricValue(error)});
  };
  add("a", "1", "passed", 10, 5);
  add("a", "1", "passed", 20, 9);
  add("a", "2", "passed", 30, 30);
  add("b", "1", "failed", 1, 1);
  add("b", "1", "passed", 40, 40);
  EXPECT_EQ(fronts_by_scene(table), (std::vector<std::vector<std::size_t>>{{0}, {2}, {4}}));
  EXPECT_EQ(scene_text(table, 2), "a, light.0.color=2");
}

}  // namespace
}  // namespace phongpipe
