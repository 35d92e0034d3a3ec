// The SystemC pipeline over a frame: both of its details give the same pixels in the same cycles,
// which are those of the model, whatever queues, costs and stalls there are.
#include "sim/pipeline.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "model/files/scene_file.h"
#include "model/fixed/model_frame.h"
#include "model/scene/input_error.h"
#include "sim/datapath_registers.h"
#include "testbench/cases/random_effects.h"
#include "testbench/cases/recorded_model.h"
#include "testbench/tests/sim/simulations.h"

namespace phongpipe {
namespace {

void expect_same(const Trace& by_span, const Trace& by_clock) {
  EXPECT_EQ(by_span.counts.failure, "");
  EXPECT_EQ(by_clock.counts.failure, "");
  EXPECT_EQ(by_span.counts.setup_cycles, by_clock.counts.setup_cycles);
  EXPECT_EQ(by_span.counts.walker_cycles, by_clock.counts.walker_cycles);
  EXPECT_EQ(by_span.counts.framebuffer_cycles, by_clock.counts.framebuffer_cycles);
  EXPECT_EQ(by_span.counts.pixel_groups, by_clock.counts.pixel_groups);
  EXPECT_EQ(by_span.counts.rom_load_cycles, by_clock.counts.rom_load_cycles);
  EXPECT_EQ(by_span.counts.datapath_cycles, by_clock.counts.datapath_cycles);
  EXPECT_EQ(by_span.counts.frame_cycles, by_clock.counts.frame_cycles);
  EXPECT_TRUE(by_span.colors == by_clock.colors);
  ASSERT_EQ(by_span.stream.size(), by_clock.stream.size());
  ASSERT_EQ(by_span.cycles.size(), by_clock.cycles.size());
  for (std::size_t i = 0; i < by_span.stream.size(); ++i) {
    ASSERT_EQ(by_span.stream[i], by_clock.stream[i]) << "pixel " << i;
    ASSERT_EQ(by_span.cycles[i], by_clock.cycles[i]) << "pixel " << i;
  }
}

void expect_model(const Trace& trace, const RecordedModel& model) {
  EXPECT_TRUE(trace.stream == model.stream);
  EXPECT_TRUE(trace.colors == model.colors());
}

// With and without a ClockedDatapath in place of the closed form by the span.
void expect_agreement(const FrameSetup& frame, const PipelineConfiguration& configuration,
                      SimulationOptions options) {
  const Trace by_span = simulate_apart(frame, configuration, options);
  options.detail = Detail::cycle;
  const Trace by_clock = simulate_apart(frame, configuration, options);
  DatapathRegisters datapath(frame.configuration, frame.cue_color);
  options.datapath = &datapath;
  options.detail = Detail::span;
  const Trace clocked_by_span = simulate_apart(frame, configuration, options);
  ASSERT_FALSE(by_span.stream.empty()) << "nothing is drawn";
  expect_model(by_span, record_model(frame));
  expect_same(by_span, by_clock);
  expect_same(clocked_by_span, by_clock);
  EXPECT_EQ(clocked_by_span.counts.datapath_busy_cycles, by_clock.counts.datapath_busy_cycles);
}

class OfScene : public testing::TestWithParam<const char*> {};

TEST_P(OfScene, BySpanIsByCycle) {
  const Scene scene = load_scene(std::string(PHONGPIPE_SCENES "/") + GetParam() + ".toml");
  const Geometry geometry = make_geometry(scene);
  FrameConfiguration datapath;
  datapath.channels = is_grey(scene, geometry) ? 1 : 3;
  const FrameSetup frame(scene, geometry, with_derived_blocks(datapath, scene, geometry));
  SimulationOptions options;
  expect_agreement(frame, PipelineConfiguration(), options);
  options.stall_percent = 20;
  expect_agreement(frame, PipelineConfiguration(), options);
}

std::string scene_name(const testing::TestParamInfo<const char*>& info) {
  std::string name = info.param;
  for (char& letter : name) letter = letter == '-' ? '_' : letter;
  return name;
}
INSTANTIATE_TEST_SUITE_P(Pipeline, OfScene,
                         testing::Values("mesh", "screen-triangles", "sphere", "teapot", "torus",
                                         "two-planes"),
                         scene_name);

TEST(Pipeline, BySpanIsByCycleForAnyConfiguration) {
  const unsigned first_seed = 59;
  for (unsigned seed = first_seed; seed < first_seed + 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = lit_scene(96, 64);
    const int triangles = random.integer(1, 40);
    const Geometry geometry = random_geometry(random, scene, triangles, random.uniform(2, 20));
    FrameConfiguration datapath;
    datapath.rom_address_bits = 6;  // short loads, so that other waits show
    const PipelineConfiguration pipeline = random_pipeline(random);
    SimulationOptions options;
    options.stall_percent = random.integer(0, 1) * random.integer(1, 60);
    options.stall_seed = seed;
    for (const auto& [kind, name, module, lanes] : kDatapathKinds) {
      SCOPED_TRACE(name);
      datapath.kind = kind;
      expect_agreement(FrameSetup(scene, geometry, datapath), pipeline, options);
    }
    if (HasFailure()) return;
  }
}

// Several lights, depth cueing, and any blocks left out.
TEST(Pipeline, BySpanIsByCycleForAnyEffects) {
  const unsigned first_seed = 60;
  for (unsigned seed = first_seed; seed < first_seed + 40; ++seed) {
    Random random(seed);
    const RandomEffects e = random_effects(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + text(e));
    const Effects effects = random.integer(0, 3) > 0 ? Effects::derived : Effects::all;
    const FrameSetup frame(e.scene, e.geometry,
                           with_derived_blocks(e.configuration, e.scene, e.geometry, effects),
                           effects);
    SimulationOptions options;
    options.stall_percent = random.integer(0, 1) * random.integer(1, 60);
    options.stall_seed = seed;
    expect_agreement(frame, random_pipeline(random), options);
    if (HasFailure()) return;
  }
}

TEST(Pipeline, AnEmptyFrameTakesNoTime) {
  const Scene scene = lit_scene(16, 16);
  const Geometry geometry;
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  for (const Detail detail : {Detail::span, Detail::cycle}) {
    SimulationOptions options;
    options.detail = detail;
    const Trace trace = simulate_apart(frame, PipelineConfiguration(), options);
    EXPECT_EQ(trace.counts.failure, "");
    EXPECT_EQ(trace.counts.frame_cycles, 0);
    EXPECT_TRUE(trace.stream.empty());
  }
}

TEST(Pipeline, EachChangeOfTableLoadsIt) {
  Random random(61);
  const Scene scene = lit_scene(64, 64);
  Geometry geometry = random_geometry(random, scene, 5, 15);
  const std::array<std::uint32_t, 5> materials = {1, 1, 0, 0, 1};
  for (std::size_t i = 0; i < 5; ++i) geometry.triangles[i].material = materials[i];
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  for (const Detail detail : {Detail::span, Detail::cycle}) {
    SimulationOptions options;
    options.detail = detail;
    const Trace trace = simulate_apart(frame, PipelineConfiguration(), options);
    EXPECT_EQ(trace.counts.rom_load_cycles, 3 * 1024);
    EXPECT_GT(trace.counts.datapath_cycles, 3 * 1024);
  }
}

TEST(Pipeline, SimulatesOnceAProcess) {
  Random random(67);
  const Scene scene = lit_scene(16, 16);
  const Geometry geometry = random_geometry(random, scene, 1, 5);
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  Child child([&] {
    simulate(frame, PipelineConfiguration(), {});
    try {
      simulate(frame, PipelineConfiguration(), {});
    } catch (const std::logic_error& error) {
      return std::string("refused: ") + error.what();
    }
    return std::string("simulated twice");
  });
  const std::string outcome = child.get();
  EXPECT_EQ(outcome.rfind("refused: SystemC elaborates once", 0), 0U) << outcome;
}

}  // namespace
}  // namespace phongpipe
