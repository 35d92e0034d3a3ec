// What must not change a picture, in the model and in SystemC: building more than the scene needs,
// effects that have no effect, colour where all is grey, the order of triangles and of lights.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "model/fixed/front_end.h"
#include "model/fixed/model_frame.h"
#include "testbench/cases/random_effects.h"
#include "testbench/tests/sim/simulations.h"

namespace phongpipe {
namespace {

constexpr unsigned kEffectsFirstSeed = 73;
constexpr unsigned kModelSeeds = 300;
constexpr unsigned kSimulatedSeeds = 25;  // each of its simulations is a process
constexpr int kDepthBits = 24;

using Colors = std::vector<std::uint32_t>;

// One way to give a frame's picture.
struct Account {
  const char* name;
  std::function<Colors(const FrameSetup&)> picture;
  unsigned seeds;
};

Colors simulated(const FrameSetup& frame, Detail detail) {
  SimulationOptions options;
  options.detail = detail;
  const Trace trace = simulate_apart(frame, PipelineConfiguration(), options);
  EXPECT_EQ(trace.counts.failure, "");
  return trace.colors;
}

const Account kAccounts[] = {
    {"Model", [](const FrameSetup& f) { return run_model(f).colors(); }, kModelSeeds},
    {"BySpan", [](const FrameSetup& f) { return simulated(f, Detail::span); }, kSimulatedSeeds},
    {"ByCycle", [](const FrameSetup& f) { return simulated(f, Detail::cycle); }, kSimulatedSeeds}};

// `same`: whether a random scene's picture is the same in two ways.
class Picture : public testing::TestWithParam<Account> {
 protected:
  Colors picture(const Scene& scene, const Geometry& geometry,
                 const FrameConfiguration& configuration,
                 Effects effects = Effects::derived) const {
    const FrameSetup frame(scene, geometry, configuration, effects);
    return GetParam().picture(frame);
  }
  // As a user's scene is: by the hardware that suits it.
  Colors picture(const RandomEffects& e) const {
    return picture(e.scene, e.geometry, with_derived_blocks(e.configuration, e.scene, e.geometry));
  }

  void for_each_scene(const std::function<void(Random&, RandomEffects)>& check,
                      bool grey = false) const {
    for (unsigned seed = kEffectsFirstSeed; seed < kEffectsFirstSeed + GetParam().seeds; ++seed) {
      Random random(seed);
      const RandomEffects effects = random_effects(random, grey);
      SCOPED_TRACE("seed " + std::to_string(seed) + ": " + text(effects));
      check(random, effects);
      if (HasFailure()) return;
    }
  }
};

void expect_same(const Colors& a, const Colors& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i], b[i]) << "pixel " << i << std::hex << ": " << a[i] << " and " << b[i];
  }
}

TEST_P(Picture, IsTheSameByHardwareThatHasEverything) {
  for_each_scene([&](Random&, const RandomEffects& e) {
    const FrameConfiguration all =
        with_derived_blocks(e.configuration, e.scene, e.geometry, Effects::all);
    expect_same(picture(e), picture(e.scene, e.geometry, all, Effects::all));
  });
}

TEST_P(Picture, WithoutSpecularColorNeedsNoHighlight) {
  for_each_scene([&](Random&, RandomEffects e) {
    for (Material& material : e.geometry.materials) material.specular = Color::Zero();
    FrameConfiguration with = e.configuration, without = e.configuration;
    with.specular = true;
    without.specular = false;
    with.depth_cue = without.depth_cue = e.scene.depth_cue.has_value();
    expect_same(picture(e.scene, e.geometry, with, Effects::all),
                picture(e.scene, e.geometry, without, Effects::all));
  });
}

TEST_P(Picture, WithoutDiffuseColorNeedsNoDiffuseSeries) {
  for_each_scene([&](Random&, RandomEffects e) {
    for (Material& material : e.geometry.materials) material.diffuse = Color::Zero();
    FrameConfiguration with = e.configuration;
    with.diffuse = true;
    with.depth_cue = e.scene.depth_cue.has_value();
    if (with.gate == GateSource::diffuse) with.gate = GateSource::series;
    FrameConfiguration without = with;
    without.diffuse = false;
    expect_same(picture(e.scene, e.geometry, with, Effects::all),
                picture(e.scene, e.geometry, without, Effects::all));
  });
}

TEST_P(Picture, WhereNothingFadesIsThatWithoutDepthCueing) {
  for_each_scene([&](Random& random, RandomEffects e) {
    e.scene.depth_cue = DepthCue{1e5, 2e5, random_light(random, false)};
    const Colors cued = picture(e);
    e.scene.depth_cue.reset();
    expect_same(cued, picture(e));
  });
}

TEST_P(Picture, WhereEverythingHasFadedIsOfTheCuesColor) {
  for_each_scene([&](Random&, RandomEffects e) {
    e.scene.depth_cue = DepthCue{1, 2, Color(0.2, 0.4, 1)};
    const Colors colors = picture(e);
    const FrameSetup frame(e.scene, e.geometry, e.configuration);
    const ModelFrame model = run_model(frame);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (!model.framebuffer.covered(i)) continue;
      ASSERT_EQ(colors[i], 0xff6633U) << "pixel " << i;  // 51, 102, 255
    }
  });
}

TEST_P(Picture, InGreyIsThatOfEachOfThreeChannels) {
  for_each_scene(
      [&](Random&, RandomEffects e) {
        Colors grey = picture(e);
        for (std::uint32_t& color : grey) color *= 0x010101;
        e.configuration.channels = 3;
        expect_same(grey, picture(e));
      },
      true);
}

// A pass is off by half an LSB at most, where words of 12 bits and the series leave next to nothing
// to it. So two passes together and the one of the whole light differ by less than 1.5 LSB and a
// little, which is 1 LSB, both being whole.
TEST_P(Picture, OfTwoHalvesOfALightIsThatOfTheLight) {
  std::size_t compared = 0;
  for_each_scene([&](Random&, RandomEffects e) {
    e.scene.depth_cue.reset();  // a third rounding
    e.scene.lights.resize(1);
    e.configuration.rom_data_bits = 12;
    e.configuration.anchor = Anchor::span;
    const Colors whole = picture(e);
    e.scene.lights.resize(2, e.scene.lights[0]);
    for (Light& light : e.scene.lights) light.color *= 0.5;
    const Colors halves = picture(e);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      for (int shift = 0; shift < 24; shift += 8) {
        const int one = static_cast<int>(whole[i] >> shift & 0xff);
        const int two = static_cast<int>(halves[i] >> shift & 0xff);
        if (one == kOutputMax || two == kOutputMax) continue;  // saturated
        ASSERT_LE(std::abs(one - two), 1) << "pixel " << i << ", bit " << shift;
        ++compared;
      }
    }
  });
  EXPECT_GT(compared, 10'000U);
}

// For each pixel, whether two triangles share the nearest depth.
std::vector<bool> ties(const FrameSetup& frame) {
  const FrontEnd front_end(frame);
  std::map<std::size_t, std::uint32_t> nearest;
  std::vector<bool> tied(static_cast<std::size_t>(frame.width) *
                         static_cast<std::size_t>(frame.height));
  TriangleWork work;
  for (std::uint32_t triangle = 0; triangle < front_end.triangles(); ++triangle) {
    if (front_end.set_up(triangle, 0, work) != SetupOutcome::ready) continue;
    for (const RowSpan& row : work.rows) {
      const Span span = front_end.span_walker().start(work.setup, row);
      for (int i = 0; i < row.length; ++i) {
        const auto index = static_cast<std::size_t>(row.y * frame.width + row.x + i);
        const std::uint32_t depth = Framebuffer::depth(frame, span, i);
        const auto [place, first] = nearest.emplace(index, depth);
        if (first || depth > place->second) continue;
        tied[index] = depth == place->second;
        place->second = depth;
      }
    }
  }
  return tied;
}

TEST_P(Picture, DoesNotDependOnTheOrderOfTriangles) {
  std::size_t compared = 0;
  for_each_scene([&](Random& random, RandomEffects e) {
    const Colors ordered = picture(e);
    const std::vector<bool> tied =
        ties(FrameSetup(e.scene, e.geometry, e.configuration, Effects::all));
    std::vector<ScreenTriangle>& triangles = e.geometry.triangles;
    for (std::size_t i = triangles.size(); i > 1; --i) {
      std::swap(triangles[i - 1],
                triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    }
    const Colors permuted = picture(e);
    for (std::size_t i = 0; i < tied.size(); ++i) {
      if (tied[i]) continue;
      ASSERT_EQ(ordered[i], permuted[i]) << "pixel " << i;
      ++compared;
    }
  });
  EXPECT_GT(compared, 10'000U);
}

TEST_P(Picture, DoesNotDependOnTheOrderOfFurtherLights) {
  for_each_scene([&](Random&, RandomEffects e) {
    const Colors ordered = picture(e);
    std::reverse(e.scene.lights.begin() + 1, e.scene.lights.end());
    expect_same(ordered, picture(e));
  });
}

// Also where the black one is lit by nothing at all: no pixel may be added twice.
TEST_P(Picture, DoesNotChangeByABlackLight) {
  for_each_scene([&](Random& random, RandomEffects e) {
    const Colors before = picture(e);
    e.scene.lights.emplace_back();
    e.scene.lights.back().direction = -random.unit_near(Vec3(0, 0, 1), 70);
    e.scene.lights.back().color = Color::Zero();
    expect_same(before, picture(e));
  });
}

INSTANTIATE_TEST_SUITE_P(Effects, Picture, testing::ValuesIn(kAccounts),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace phongpipe
