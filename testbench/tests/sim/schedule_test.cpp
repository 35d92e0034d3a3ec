// The setup engine's time: list scheduling of a dataflow on a given number of units.
#include "sim/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "testbench/system/random.h"

namespace phongpipe {
namespace {

constexpr int kInput = Dataflow::kInput;

// What the setup engine has units for.
constexpr std::array<Operation, 4> kOperations = {Operation::add, Operation::multiply,
                                                  Operation::rsqrt, Operation::power};

PipelineConfiguration units(const Units& adders, const Units& multipliers = {1, 3, 1},
                            const Units& rsqrt = {1, 10, 2}, const Units& power = {1, 8, 1}) {
  PipelineConfiguration configuration;
  configuration.adders = adders;
  configuration.multipliers = multipliers;
  configuration.rsqrt = rsqrt;
  configuration.power = power;
  return configuration;
}

const Units& units_of(Operation operation, const PipelineConfiguration& c) {
  return operation == Operation::add        ? c.adders
         : operation == Operation::multiply ? c.multipliers
         : operation == Operation::rsqrt    ? c.rsqrt
                                            : c.power;
}

TEST(Schedule, OfNothingTakesNoTime) {
  EXPECT_EQ(schedule_cycles({}, PipelineConfiguration()), 0);
}

TEST(Schedule, AChainTakesTheSumOfItsLatencies) {
  const Dataflow chain = {{{Operation::add, kInput, kInput},
                           {Operation::multiply, 0, kInput},
                           {Operation::rsqrt, 1, kInput},
                           {Operation::add, 2, 1},
                           {Operation::multiply, 3, 3},
                           {Operation::power, 4, kInput}}};
  EXPECT_EQ(schedule_cycles(chain, units({2, 2, 1})), 2 + 3 + 10 + 2 + 3 + 8);
  EXPECT_EQ(schedule_cycles(chain, units({9, 1, 1}, {9, 1, 1}, {9, 1, 1}, {9, 1, 1})), 6);
}

TEST(Schedule, IndependentOperationsShareTheUnits) {
  for (const int count : {1, 2, 3, 8}) {
    for (const int latency : {1, 4}) {
      for (const int interval : {1, 3}) {
        for (const int operations : {1, 2, 7, 8, 9}) {
          const Dataflow adds = {std::vector<Dataflow::Node>(static_cast<std::size_t>(operations),
                                                             {Operation::add, kInput, kInput})};
          const int rounds = (operations + count - 1) / count;
          EXPECT_EQ(schedule_cycles(adds, units({count, latency, interval})),
                    (rounds - 1) * interval + latency)
              << operations << " additions on " << count << " adders";
        }
      }
    }
  }
}

// One adder, three additions, of which the root hangs on one: wherever that one stands, it goes
// first.
TEST(Schedule, StartsTheLongestRemainingPathFirst) {
  for (const int head : {0, 1, 2}) {
    const Dataflow graph = {{{Operation::add, kInput, kInput},
                             {Operation::add, kInput, kInput},
                             {Operation::add, kInput, kInput},
                             {Operation::rsqrt, head, kInput}}};
    EXPECT_EQ(schedule_cycles(graph, units({1, 1, 1})), 1 + 10) << "head of the chain: " << head;
  }
}

TEST(Schedule, ATreeWaitsForItsLaterOperand) {
  const Dataflow graph = {{{Operation::rsqrt, kInput, kInput},
                           {Operation::add, kInput, kInput},
                           {Operation::add, 1, 0},
                           {Operation::add, 2, 2}}};
  EXPECT_EQ(schedule_cycles(graph, units({2, 2, 1})), 10 + 2 + 2);
}

TEST(Schedule, HasNoUnitsForWhatOnlySoftwareDoes) {
  const Dataflow graph = {{{Operation::divide, kInput, kInput}}};
  EXPECT_THROW(schedule_cycles(graph, PipelineConfiguration()), std::logic_error);
}

// From the start of the first operation to the end of the last, on units without limit.
int critical_path(const Dataflow& graph, const PipelineConfiguration& c) {
  std::vector<int> end;
  int longest = 0;
  for (const Dataflow::Node& node : graph.nodes) {
    int start = 0;
    for (const int operand : {node.left, node.right}) {
      if (operand != kInput) start = std::max(start, end[static_cast<std::size_t>(operand)]);
    }
    end.push_back(start + units_of(node.operation, c).latency);
    longest = std::max(longest, end.back());
  }
  return longest;
}

// The time the units of one kind need, whatever the order.
int work_bound(const Dataflow& graph, const PipelineConfiguration& c, Operation operation) {
  const int operations = static_cast<int>(
      std::count_if(graph.nodes.begin(), graph.nodes.end(),
                    [operation](const auto& node) { return node.operation == operation; }));
  if (operations == 0) return 0;
  const Units& unit = units_of(operation, c);
  return ((operations + unit.count - 1) / unit.count - 1) * unit.interval + unit.latency;
}

void expect_possible(const Dataflow& graph, const PipelineConfiguration& c) {
  const int cycles = schedule_cycles(graph, c);
  EXPECT_GE(cycles, critical_path(graph, c));
  int one_by_one = 0;
  for (const Operation operation : kOperations) {
    EXPECT_GE(cycles, work_bound(graph, c, operation));
  }
  for (const Dataflow::Node& node : graph.nodes) {
    const Units& unit = units_of(node.operation, c);
    one_by_one += std::max(unit.latency, unit.interval);
  }
  EXPECT_LE(cycles, one_by_one) << "slower than one operation at a time";
  PipelineConfiguration plenty = c;
  const int nodes = static_cast<int>(graph.nodes.size());
  plenty.adders.count = plenty.multipliers.count = plenty.rsqrt.count = plenty.power.count = nodes;
  EXPECT_EQ(schedule_cycles(graph, plenty), critical_path(graph, c));
}

TEST(Schedule, LiesBetweenItsBoundsOnRandomGraphs) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  const auto pick = [&random](int low, int high) { return random.integer(low, high); };
  for (int i = 0; i < 300; ++i) {
    Dataflow graph;
    const int nodes = pick(1, 60);
    for (int k = 0; k < nodes; ++k) {
      const Operation operation = kOperations[static_cast<std::size_t>(pick(0, 3))];
      graph.nodes.push_back(
          {operation, pick(-1, k - 1), operation == Operation::rsqrt ? kInput : pick(-1, k - 1)});
    }
    const auto random_units = [&] { return Units{pick(1, 4), pick(1, 12), pick(1, 4)}; };
    expect_possible(graph, units(random_units(), random_units(), random_units(), random_units()));
    if (testing::Test::HasFailure()) FAIL() << "graph " << i;
  }
}

OperationCounts recorded(const std::function<void()>& work) {
  Recording recording;
  work();
  return recording.dataflow().counts();
}

const std::vector<SeriesFit> kFits = {SeriesFit::taylor, SeriesFit::six_point, SeriesFit::weighted,
                                      SeriesFit::focused};

TEST(Schedule, OfDiffuseLightAloneHasNoOperationOfTheHighlight) {
  const TriangleInput<Recorded> triangle{};
  const LightInput<Recorded> light{};
  for (const SeriesFit fit : kFits) {
    for (const bool local_viewer : {false, true}) {
      SeriesPlan plan;
      plan.specular = SeriesForm::absent;
      plan.form.local_viewer = local_viewer;  // whose halfway vectors nothing needs
      plan.form.fit = fit;
      const OperationCounts needed = recorded([&] {
        const Interpolator<Recorded> interpolate(triangle.x, triangle.y);
        interpolate(triangle.z[0], triangle.z[1], triangle.z[2]);
        fit_series(fit, interpolate, triangle.normal, light.terms.to_light, light.terms.halfway,
                   light.terms.sharpness, {true, false})
            .light.scaled(light.diffuse_scale[0]);
      });
      EXPECT_TRUE(record_setup(plan).counts() == needed) << "fit " << static_cast<int>(fit);
      plan.specular = SeriesForm::fitted;
      EXPECT_GT(record_setup(plan).counts().multiply, needed.multiply);
    }
  }
  // By hand for Taylor's: 1/|det| and 1/|C|, and no more.
  SeriesPlan plan;
  plan.specular = SeriesForm::absent;
  EXPECT_EQ(record_setup(plan).counts().rsqrt, 2U);
}

TEST(Schedule, OfAHighlightAloneHasNoOperationOfDiffuseLight) {
  const TriangleInput<Recorded> triangle{};
  const LightInput<Recorded> light{};
  for (const SeriesFit fit : kFits) {
    SeriesPlan plan;
    plan.diffuse = SeriesForm::absent;
    plan.form.fit = fit;
    const OperationCounts needed = recorded([&] {
      const Interpolator<Recorded> interpolate(triangle.x, triangle.y);
      interpolate(triangle.z[0], triangle.z[1], triangle.z[2]);
      fit_series(fit, interpolate, triangle.normal, light.terms.to_light, light.terms.halfway,
                 light.terms.sharpness, {false, true})
          .highlight.scaled(light.specular_scale);
    });
    EXPECT_TRUE(record_setup(plan).counts() == needed) << "fit " << static_cast<int>(fit);
    plan.gate = SeriesForm::fitted;  // needs N·L
    EXPECT_GT(record_setup(plan).counts().multiply, needed.multiply);
  }
}

TEST(Schedule, OfAmbientLightAloneInterpolatesOnly) {
  const TriangleInput<Recorded> triangle{};
  const auto interpolated = [&](bool depth, bool depth_cue) {
    return recorded([&] {
      const Interpolator<Recorded> interpolate(triangle.x, triangle.y);
      if (depth) interpolate(triangle.z[0], triangle.z[1], triangle.z[2]);
      const auto& share = triangle.cue_factor;
      if (depth_cue) interpolate(share[0], share[1], share[2]);
    });
  };
  SeriesPlan plan;
  plan.diffuse = plan.specular = SeriesForm::absent;
  for (const bool depth : {false, true}) {
    for (const bool depth_cue : {false, true}) {
      plan.depth = depth;
      plan.depth_cue = depth_cue;
      EXPECT_TRUE(record_setup(plan).counts() == interpolated(depth, depth_cue));
    }
  }
}

TEST(Schedule, WhatAPlanLeavesOutSavesTime) {
  const PipelineConfiguration units;
  SetupTimes times(units);
  SeriesPlan full, no_depth, diffuse_only, ambient_only;
  no_depth.depth = false;
  diffuse_only.specular = SeriesForm::absent;
  ambient_only.specular = ambient_only.diffuse = SeriesForm::absent;
  EXPECT_GT(times.of(full).cycles, times.of(diffuse_only).cycles);
  EXPECT_GT(times.of(diffuse_only).cycles, times.of(ambient_only).cycles);
  EXPECT_GE(times.of(full).cycles, times.of(no_depth).cycles);
  EXPECT_EQ(times.of(full).cycles, schedule_cycles(record_setup(full), units));
  EXPECT_TRUE(times.of(diffuse_only).operations == record_setup(diffuse_only).counts());
}

TEST(Schedule, OfTheSetupLiesBetweenItsBounds) {
  for (const bool local_viewer : {false, true}) {
    SeriesPlan plan;
    plan.form.local_viewer = local_viewer;
    const Dataflow graph = record_setup(plan);
    expect_possible(graph, PipelineConfiguration());
    expect_possible(graph, units({1, 1, 1}, {1, 1, 1}, {1, 1, 1}));
  }
}

}  // namespace
}  // namespace phongpipe
