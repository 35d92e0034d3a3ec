// The timeline of a scene is that of the frame that verify() verifies.
#include "testbench/trace/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"

namespace phongpipe {
namespace {

struct Case {
  std::vector<std::string> settings;
  VerificationOptions options;
};

std::vector<Case> cases() {
  std::vector<Case> all(4);
  all[1].options.stall_percent = 30;
  all[1].options.seed = 5;
  all[2].options.effects = EffectsToVerify::all;
  all[3].settings = {"framebuffer.write_cycles=3", "rom_address_bits=6"};
  return all;
}

std::shared_ptr<const PreparedScene> prepared(const std::string& name) {
  return std::make_shared<const PreparedScene>(load_named_scene(name));
}

TEST(Timeline, IsOfTheFrameThatIsVerified) {
  for (const char* name : {"sphere", "screen-triangles", "effects/two-lights", "random:7"}) {
    const auto scene = prepared(name);
    for (Case one : cases()) {
      SCOPED_TRACE(name);
      one.options.rtl = RtlToVerify::off;
      const Hardware hardware = load_hardware("default", one.settings);
      const VerificationResult verified = verify(scene, hardware, one.options);
      const Timeline timeline = record_timeline(scene, hardware, one.options);
      EXPECT_EQ(timeline.frame_cycles, verified.systemc.counts.frame_cycles);
      for (const Module module : kModules) {
        const StateCycles cycles = state_cycles(timeline, module);
        EXPECT_EQ(std::accumulate(cycles.begin(), cycles.end(), std::int64_t{0}),
                  timeline.frame_cycles);
      }
      const auto in = [&timeline](Module module, ModuleState state) {
        return state_cycles(timeline, module)[static_cast<std::size_t>(state)];
      };
      EXPECT_EQ(in(Module::pixel_datapath, ModuleState::loading),
                verified.systemc.counts.rom_load_cycles);
      EXPECT_EQ(in(Module::pixel_datapath, ModuleState::busy),
                static_cast<std::int64_t>(verified.pixels));
    }
  }
}

// A split triangle is counted as the one it was.
TEST(Timeline, NamesTrianglesOfTheScene) {
  const auto scene = prepared("screen-triangles");
  const Timeline timeline = record_timeline(scene, load_hardware("default", {}), {});
  for (const Module module : kModules) {
    std::vector<std::uint32_t> found;
    timeline.for_each_run(
        module, [&](ModuleState state, std::uint32_t triangle, std::int64_t, std::int64_t) {
          if (state == ModuleState::busy) found.push_back(triangle);
        });
    EXPECT_EQ(*std::min_element(found.begin(), found.end()), 0U) << name(module);
    EXPECT_EQ(*std::max_element(found.begin(), found.end()), 5U) << name(module);
  }
}

// As `verify` tells it, from counts that are kept without a timeline.
TEST(Timeline, TellsWhatLimitsTheFrame) {
  const auto limiting = [](const char* scene, const std::vector<std::string>& settings) {
    const Hardware hardware = load_hardware("default", settings);
    const std::string_view module =
        name(limiting_module(record_timeline(prepared(scene), hardware, {})));
    VerificationOptions options;
    options.rtl = RtlToVerify::off;
    options.pictures = false;
    EXPECT_EQ(verify(prepared(scene), hardware, options).limiting_block().block, module);
    return module;
  };
  EXPECT_EQ(limiting("sphere", {}), "setup_engine");
  EXPECT_EQ(limiting("sphere", {"span_walker.row_cycles=100"}), "span_walker");
  EXPECT_EQ(limiting("two-planes", {}), "pixel_datapath");
  EXPECT_EQ(limiting("two-planes", {"framebuffer.write_cycles=2"}), "framebuffer");
}

TEST(Timeline, TooLongForABrowserIsRefused) {
  try {
    record_timeline(prepared("sphere"), load_hardware("default", {}), {}, 500);
    FAIL() << "recorded";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--set scene.image.width=128"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace phongpipe
