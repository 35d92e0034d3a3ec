// The blocks of pixel_datapath in SystemC: those that are left out are not elaborated, and those
// that are there execute what the configuration says.
#include "sim/datapath_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "model/fixed/model_frame.h"
#include "sim/pipeline.h"
#include "testbench/cases/random_effects.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

constexpr unsigned kDatapathBlocksFirstSeed = 83;
constexpr unsigned kSeeds = 20;

struct Elaborated {
  std::set<std::string> modules;
  PixelOperations pixel;
  std::uint64_t depth_additions = 0;

  // How many modules of pixel_datapath, or of what `parent` is, have names that begin so.
  int count(const std::string& name, const std::string& parent = "pixel_datapath.") const {
    return static_cast<int>(std::count_if(
        modules.begin(), modules.end(),
        [&](const std::string& module) { return module.rfind(parent + name, 0) == 0; }));
  }
};

Elaborated simulate_apart(const FrameSetup& frame, Detail detail) {
  Child child([&] {
    SimulationOptions options;
    options.detail = detail;
    const SimulationResult result = simulate(frame, PipelineConfiguration(), options);
    return to_bytes(static_cast<const SimulationCounts&>(result));
  });
  const auto counts = from_bytes<SimulationCounts>(child.get());
  return {{counts.modules.begin(), counts.modules.end()},
          counts.pixel_operations,
          counts.depth_additions};
}

void expect_blocks(const Elaborated& e, const FrameSetup& frame) {
  const FrameConfiguration& c = frame.configuration;
  EXPECT_EQ(e.count("diffuse_series"), c.diffuse ? c.channels : 0);
  EXPECT_EQ(e.count("color_sum"), c.channels);
  EXPECT_EQ(e.count("specular_series"), c.specular);
  EXPECT_EQ(e.count("exponent_rom"), c.specular);
  EXPECT_EQ(e.count("gate_series"), c.has_gate_series());
  EXPECT_EQ(e.count("cue_series"), c.depth_cue);
  EXPECT_EQ(e.count("depth_cue"), c.depth_cue ? c.channels : 0);
  EXPECT_EQ(e.count("depth_test", "framebuffer."), frame.depth_test);
}

class DatapathBlocksOf : public testing::TestWithParam<Detail> {
 protected:
  void for_each_scene(Effects effects, const std::function<void(const FrameSetup&)>& check) const {
    for (unsigned seed = kDatapathBlocksFirstSeed; seed < kDatapathBlocksFirstSeed + kSeeds;
         ++seed) {
      Random random(seed);
      const RandomEffects e = random_effects(random);
      SCOPED_TRACE("seed " + std::to_string(seed) + ": " + text(e));
      const FrameConfiguration suited =
          with_derived_blocks(e.configuration, e.scene, e.geometry, effects);
      check(FrameSetup(e.scene, e.geometry, suited, effects));
      if (HasFailure()) return;
    }
  }
};

TEST_P(DatapathBlocksOf, AScenesEffectsAreElaboratedAndNoOthers) {
  for_each_scene(Effects::derived, [](const FrameSetup& frame) {
    expect_blocks(simulate_apart(frame, GetParam()), frame);
  });
}

TEST_P(DatapathBlocksOf, EverythingExecutesEveryAdderAndMultiplierForEveryPixel) {
  for_each_scene(Effects::all, [](const FrameSetup& frame) {
    const Elaborated e = simulate_apart(frame, GetParam());
    expect_blocks(e, frame);
    const FrameConfiguration& c = frame.configuration;
    const std::uint64_t pixels = run_model(frame).pixels;
    EXPECT_EQ(e.pixel.additions, static_cast<std::uint64_t>(c.adders()) * pixels);
    EXPECT_EQ(e.pixel.multiplications, static_cast<std::uint64_t>(c.multipliers()) * pixels);
    EXPECT_EQ(e.pixel.reads, pixels);
    EXPECT_EQ(e.depth_additions * frame.passes, pixels) << "depth is stepped in the first pass";
  });
}

TEST_P(DatapathBlocksOf, AScenesOwnHardwareExecutesNoMore) {
  for_each_scene(Effects::derived, [](const FrameSetup& frame) {
    const Elaborated e = simulate_apart(frame, GetParam());
    const FrameConfiguration& c = frame.configuration;
    const std::uint64_t pixels = run_model(frame).pixels;
    EXPECT_LE(e.pixel.additions, static_cast<std::uint64_t>(c.adders()) * pixels);
    EXPECT_EQ(e.pixel.multiplications, static_cast<std::uint64_t>(c.multipliers()) * pixels);
    EXPECT_LE(e.pixel.reads, c.specular ? pixels : 0);
    EXPECT_EQ(e.depth_additions == 0, !frame.depth_test || pixels == 0);
  });
}

INSTANTIATE_TEST_SUITE_P(Pipeline, DatapathBlocksOf, testing::Values(Detail::span, Detail::cycle),
                         [](const testing::TestParamInfo<Detail>& info) {
                           return info.param == Detail::span ? "BySpan" : "ByCycle";
                         });

// A span that steps nothing and shows no highlight executes no addition.
TEST(DatapathBlocks, ExecuteNothingForASpanOfAmbientLight) {
  FrameConfiguration c;
  c.channels = 3;
  DatapathBlocks blocks(c);
  Span span;
  span.row.length = 10;
  span.step_diffuse = span.step_specular = span.highlight = false;
  blocks.shade(span);
  EXPECT_EQ(blocks.operations().additions, 0U);
  EXPECT_EQ(blocks.operations().reads, 0U);
  span.step_diffuse = true;
  blocks.shade(span);
  EXPECT_EQ(blocks.operations().additions, 60U);
  span.step_specular = span.highlight = true;
  blocks.shade(span);
  EXPECT_EQ(blocks.operations().additions,
            60U + 110U);  // the paper's 5 a pixel and channel, shared
  EXPECT_EQ(blocks.operations().reads, 10U);
}

}  // namespace
}  // namespace phongpipe
