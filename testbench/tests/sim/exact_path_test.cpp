// exact_path in the pipeline: SystemC by span and by clock agree with the model on every pixel and
// with each other on its cycle; its time and operations are what its units take.
#include <gtest/gtest.h>

#include "model/files/scene_file.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "sim/schedule.h"
#include "testbench/hardware/hardware.h"
#include "testbench/tests/sim/simulations.h"

namespace phongpipe {
namespace {

struct Certified {
  Hardware hardware;
  PreparedFrame frame;

  Certified(const std::string& scene, const std::vector<std::string>& settings)
      : hardware(load_hardware("default", settings)),
        frame(small(scene), hardware.formats, hardware.setup) {}

  static Scene small(const std::string& name) {
    Scene scene = load_scene(std::string(PHONGPIPE_SCENES) + "/" + name + ".toml");
    scene.image.width = scene.image.height = 72;
    return scene;
  }
  Trace simulated(Detail detail, int stall_percent) const {
    SimulationOptions options;
    options.detail = detail;
    options.stall_percent = stall_percent;
    return simulate_apart(frame.setup, hardware.pipeline, options);
  }
};

TEST(ExactPath, IsTheSameInTheModelBySpanAndByClock) {
  for (const char* scene : {"torus", "effects/nettle", "effects/spotlight", "effects/depth-cue"}) {
    for (const char* limit : {"max_error=0.6", "max_error=1.5"}) {
      SCOPED_TRACE(std::string(scene) + " " + limit);
      const Certified certified(scene, {limit});
      const ModelFrame model = run_model(certified.frame.setup);
      EXPECT_GT(model.ledger[ShadingPath::exact_path], 0U);
      EXPECT_EQ(model.ledger.sum(), model.pixels);
      for (const int stall : {0, 40}) {
        const Trace by_span = certified.simulated(Detail::span, stall);
        const Trace by_clock = certified.simulated(Detail::cycle, stall);
        EXPECT_EQ(by_span.colors, model.colors());
        EXPECT_EQ(by_clock.colors, model.colors());
        EXPECT_EQ(by_span.stream, by_clock.stream);
        EXPECT_EQ(by_span.cycles, by_clock.cycles);
        EXPECT_EQ(by_span.counts.frame_cycles, by_clock.counts.frame_cycles);
        EXPECT_EQ(by_span.counts.exact_path_cycles, by_clock.counts.exact_path_cycles);
        EXPECT_EQ(by_span.counts.setup_cycles_by_path.sum(),
                  static_cast<std::uint64_t>(by_span.counts.setup_cycles));
      }
    }
  }
}

TEST(ExactPath, TakesTheTimeOfItsUnits) {
  const Certified certified("sphere", {"max_error=0.502"});
  const FrameSetup& frame = certified.frame.setup;
  const Material& material = frame.geometry->materials.front();
  ExactPathTimes times(certified.hardware.pipeline);
  const ExactPathTimes::Cost& cost = times.of(frame, material, 0);
  // Of a grey pixel: the normal is stepped (3), three dot products (2 each), light and highlight
  // are added to ambient light (2); dot products take 3 products each, 1/√ multiplies two of them,
  // and both terms are scaled.
  EXPECT_EQ(cost.operations.add, 3U + 3 * 2 + 2);
  EXPECT_EQ(cost.operations.multiply, 3U * 3 + 2 + 2);
  EXPECT_EQ(cost.operations.rsqrt, 1U);
  EXPECT_EQ(cost.operations.power, 1U);
  EXPECT_EQ(cost.interval_cycles, 3);  // 11 additions on 4 adders, 13 products on 6 multipliers

  const ModelFrame model = run_model(frame);
  const std::uint64_t pixels = model.ledger[ShadingPath::exact_path];
  ASSERT_GT(pixels, model.pixels / 2);
  const auto& triangles = frame.certificates->triangles;
  const auto exact = std::count_if(triangles.begin(), triangles.end(),
                                   [](const Certificates::Triangle& t) { return t.exact; });
  const SimulationCounts counts = certified.simulated(Detail::span, 0).counts;
  EXPECT_EQ(counts.exact_path_operations, pixels * cost.operations);
  EXPECT_EQ(counts.exact_path_cycles,
            static_cast<std::int64_t>(pixels) * cost.interval_cycles + exact * cost.latency_cycles);
  EXPECT_GE(counts.frame_cycles, static_cast<std::int64_t>(pixels) * cost.interval_cycles);
}

TEST(ExactPath, IsBuiltOnlyIfErrorsAreCertified) {
  const auto has_module = [](const SimulationCounts& counts) {
    return std::find(counts.modules.begin(), counts.modules.end(), "span_walker.exact_path") !=
           counts.modules.end();
  };
  EXPECT_FALSE(has_module(Certified("sphere", {}).simulated(Detail::span, 0).counts));
  for (const Detail detail : {Detail::span, Detail::cycle}) {
    EXPECT_TRUE(has_module(Certified("sphere", {"max_error=2"}).simulated(detail, 0).counts));
  }
}

}  // namespace
}  // namespace phongpipe
