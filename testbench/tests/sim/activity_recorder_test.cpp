// What the modules tell of each clock accounts for every cycle of the frame, agrees with what the
// frame asks of each module and with the queues, and changes nothing.
#include "sim/activity_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "model/files/scene_file.h"
#include "model/fixed/prepared_frame.h"
#include "sim/frame_context.h"
#include "testbench/cases/random_effects.h"
#include "testbench/tests/sim/simulations.h"

namespace phongpipe {

struct RecordedActivity {
  Trace trace;
  bool complete = false;
  std::vector<ModuleActivity> modules;

  static constexpr auto fields() {
    using R = RecordedActivity;
    return std::make_tuple(field("trace", &R::trace), field("complete", &R::complete),
                           field("modules", &R::modules));
  }
};

namespace {

using S = ModuleState;

RecordedActivity record(const FrameSetup& frame, const PipelineConfiguration& pipeline,
                        SimulationOptions options, std::size_t most_events = 10'000'000) {
  options.detail = Detail::cycle;
  Child child([&] {
    ActivityRecorder recorder(most_events);
    options.activity = &recorder;
    const SimulationResult result = simulate(frame, pipeline, options);
    return to_bytes(RecordedActivity{trace_of(result), recorder.complete(), recorder.take()});
  });
  return from_bytes<RecordedActivity>(child.get());
}

// A module's state, or the fill of a queue, in each cycle.
template <typename Value>
std::vector<Value> by_cycle(const std::vector<std::int64_t>& starts,
                            const std::vector<Value>& values, std::int64_t frame_cycles) {
  std::vector<Value> result;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_EQ(starts[i], static_cast<std::int64_t>(result.size())) << "a gap, or an overlap";
    const std::int64_t end = i + 1 < starts.size() ? starts[i + 1] : frame_cycles;
    EXPECT_GT(end, starts[i]) << "an empty run";
    result.insert(result.end(),
                  static_cast<std::size_t>(std::max<std::int64_t>(end - starts[i], 0)), values[i]);
  }
  EXPECT_EQ(static_cast<std::int64_t>(result.size()), frame_cycles);
  return result;
}

// What the frame asks of the modules, computed without simulating it.
struct Work {
  std::int64_t setup = 0, walker = 0;  // cycles
};

Work work_of(const FrameSetup& frame, const PipelineConfiguration& pipeline) {
  const FrontEnd front_end(frame);
  SetupTimes times(pipeline);
  TriangleWork triangle;
  Work work;
  std::int64_t setup = 0;
  for (TriangleOrder next(front_end); !next.done(); next.advance()) {
    const SetupOutcome outcome = front_end.set_up(next.triangle(), next.pass(), triangle);
    if (outcome != SetupOutcome::nothing) setup += times.of(triangle.setup.plan).cycles;
    if (outcome != SetupOutcome::ready) continue;
    work.setup = setup;  // what is left out after the last triangle delays nothing
    const auto rows = static_cast<std::int64_t>(triangle.rows.size());
    work.walker += 1 + pipeline.walker_triangle_cycles + (rows - 1) * pipeline.walker_row_cycles;
  }
  return work;
}

void expect_undisturbed(const Trace& recorded, const Trace& plain) {
  EXPECT_TRUE(equal_fields(recorded.counts.pixel_operations, plain.counts.pixel_operations));
  EXPECT_EQ(recorded.counts.frame_cycles, plain.counts.frame_cycles);
  EXPECT_TRUE(recorded.stream == plain.stream);
  EXPECT_TRUE(recorded.cycles == plain.cycles);
  EXPECT_TRUE(recorded.colors == plain.colors);
}

// Whether `values` have `value` in the cycle or in the one before it.
bool just_was(const std::vector<std::uint32_t>& values, std::size_t cycle, int value) {
  const auto wanted = static_cast<std::uint32_t>(value);
  return values[cycle] == wanted || (cycle > 0 && values[cycle - 1] == wanted);
}

void expect_accounted(const FrameSetup& frame, const PipelineConfiguration& pipeline,
                      const SimulationOptions& options) {
  const RecordedActivity recorded = record(frame, pipeline, options);
  expect_undisturbed(recorded.trace, simulate_apart(frame, pipeline, options));
  EXPECT_TRUE(recorded.complete);
  const SimulationCounts& counts = recorded.trace.counts;
  const auto pixels = static_cast<std::int64_t>(recorded.trace.stream.size());
  ASSERT_GT(pixels, 0) << "nothing is drawn";
  ASSERT_EQ(recorded.modules.size(), kModules.size());
  std::vector<std::vector<S>> states;
  std::vector<std::vector<std::uint32_t>> fills(1);  // of the queue before each module
  for (const Module module : kModules) {
    SCOPED_TRACE(name(module));
    const ModuleActivity& activity = recorded.modules[static_cast<std::size_t>(module)];
    states.push_back(by_cycle(activity.starts, activity.states, counts.frame_cycles));
    if (module == Module::setup_engine) continue;
    fills.push_back(by_cycle(activity.fill_cycles, activity.fills, counts.frame_cycles));
  }
  if (testing::Test::HasFailure()) return;

  const auto cycles = [&states](Module module, S state) {
    const auto& all = states[static_cast<std::size_t>(module)];
    return std::count(all.begin(), all.end(), state);
  };
  const Work work = work_of(frame, pipeline);
  EXPECT_EQ(cycles(Module::setup_engine, S::busy), work.setup);
  EXPECT_EQ(cycles(Module::span_walker, S::busy), work.walker);
  EXPECT_EQ(cycles(Module::pixel_datapath, S::busy), pixels);
  EXPECT_EQ(cycles(Module::pixel_datapath, S::loading), counts.rom_load_cycles);
  EXPECT_EQ(pixels + cycles(Module::pixel_datapath, S::filling) +
                cycles(Module::pixel_datapath, S::stalled),
            counts.datapath_busy_cycles);
  const std::int64_t cheapest =
      std::min({pipeline.framebuffer_write_cycles, pipeline.framebuffer_test_cycles,
                pipeline.framebuffer_add_cycles});
  EXPECT_GE(cycles(Module::framebuffer, S::busy), pixels * cheapest);
  EXPECT_EQ(states.back().back(), S::busy) << "the frame ends with its last pixel";
  EXPECT_EQ(cycles(Module::setup_engine, S::waiting), 0);
  EXPECT_EQ(cycles(Module::framebuffer, S::stalled), 0);

  const int depths[] = {0, pipeline.triangle_fifo, pipeline.span_fifo, pipeline.pixel_fifo};
  for (std::size_t m = 0; m < states.size(); ++m) {
    SCOPED_TRACE(name(kModules[m]));
    for (std::size_t cycle = 0; cycle < states[m].size(); ++cycle) {
      const S state = states[m][cycle];
      // The slot that ends a stall is seen in the clock in which it is filled.
      if (state == S::stalled) {
        ASSERT_TRUE(just_was(fills[m + 1], cycle, depths[m + 1])) << cycle;
      }
      if (state == S::waiting || (m > 0 && state == S::done)) {
        ASSERT_EQ(fills[m][cycle], 0U) << cycle;
      }
      if (m > 0) {
        ASSERT_LE(fills[m][cycle], static_cast<std::uint32_t>(depths[m])) << cycle;
      }
    }
  }
}

class ActivityOfScene : public testing::TestWithParam<const char*> {};

TEST_P(ActivityOfScene, AccountsForEveryCycle) {
  const PreparedFrame frame(load_scene(std::string(PHONGPIPE_SCENES "/") + GetParam() + ".toml"),
                            FixedPointFormats(), SetupPolicy());
  SimulationOptions options;
  expect_accounted(frame.setup, PipelineConfiguration(), options);
  options.stall_percent = 20;
  expect_accounted(frame.setup, PipelineConfiguration(), options);
}

INSTANTIATE_TEST_SUITE_P(Activity, ActivityOfScene,
                         testing::Values("mesh", "screen-triangles", "sphere", "torus",
                                         "two-planes", "effects/nettle", "effects/two-lights"));

// Several lights, tables that are loaded over and over, and any blocks left out.
TEST(Activity, AccountsForEveryCycleOfAnyConfiguration) {
  const unsigned first_seed = 83;
  int loads = 0, stalled = 0;
  for (unsigned seed = first_seed; seed < first_seed + 60; ++seed) {
    Random random(seed);
    const RandomEffects e = random_effects(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + text(e));
    const FrameSetup frame(e.scene, e.geometry,
                           with_derived_blocks(e.configuration, e.scene, e.geometry));
    loads += frame.tables.size() > 1;
    SimulationOptions options;
    options.stall_percent = random.integer(0, 1) * random.integer(1, 60);
    options.stall_seed = seed;
    stalled += options.stall_percent > 0;
    expect_accounted(frame, random_pipeline(random), options);
    if (HasFailure()) return;
  }
  EXPECT_GT(loads, 5);
  EXPECT_GT(stalled, 5);
}

TEST(Activity, IsRecordedUpToTheLimit) {
  Random random(89);
  const Scene scene = lit_scene(64, 64);
  const Geometry geometry = random_geometry(random, scene, 30, 15);
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  std::size_t events = 0;
  const RecordedActivity recorded = record(frame, {}, {}, 100);
  EXPECT_FALSE(recorded.complete);
  for (const ModuleActivity& activity : recorded.modules) {
    events += activity.starts.size() + activity.fills.size();
  }
  EXPECT_GE(events, 90U);
  EXPECT_LE(events, 101U);
}

TEST(Activity, IsNotKnownByTheSpan) {
  const FrameSetup frame(lit_scene(16, 16), Geometry(), FrameConfiguration());
  Child child([&] {
    ActivityRecorder recorder(100);
    SimulationOptions options;
    options.activity = &recorder;
    try {
      simulate(frame, PipelineConfiguration(), options);
    } catch (const std::logic_error& error) {
      return std::string(error.what());
    }
    return std::string("simulated");
  });
  EXPECT_NE(child.get().find("by the clock only"), std::string::npos);
}

}  // namespace
}  // namespace phongpipe
