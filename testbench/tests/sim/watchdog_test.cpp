// A pipeline that is stuck is stopped, and says where: a datapath that never takes a span, and one
// that loses pixels.
#include <gtest/gtest.h>

#include <string>

#include "sim/datapath_registers.h"
#include "sim/pipeline.h"
#include "testbench/cases/random_frame.h"
#include "testbench/tests/sim/simulations.h"

namespace phongpipe {
namespace {

class NeverReady : public ClockedDatapath {
 public:
  void reset() override {}
  DatapathOutputs clock(const DatapathInputs&) override { return {}; }
};

// Takes spans and gives nothing back.
class Swallowing : public ClockedDatapath {
 public:
  void reset() override {}
  DatapathOutputs clock(const DatapathInputs&) override { return {true, false, {}}; }
};

constexpr int kAddressBits = 6;

FrameConfiguration small_table() {
  FrameConfiguration configuration;
  configuration.rom_address_bits = kAddressBits;
  return configuration;
}

// Delivers the last of `pixels` pixels twice.
class OneTooMany : public ClockedDatapath {
 public:
  explicit OneTooMany(std::size_t pixels) : right_(small_table()), left_(pixels) {}
  void reset() override { right_.reset(); }
  DatapathOutputs clock(const DatapathInputs& inputs) override {
    DatapathOutputs outputs = right_.clock(inputs);
    if (outputs.pixel_valid && inputs.pixel_ready) {
      last_ = outputs;
      ends_ = --left_ == 0;
    } else if (ends_) {
      outputs = last_;
      ends_ = !inputs.pixel_ready;
    }
    return outputs;
  }

 private:
  DatapathRegisters right_;
  DatapathOutputs last_;
  std::size_t left_;
  bool ends_ = false;
};

class Watchdog : public testing::TestWithParam<Detail> {
 protected:
  std::string failure(ClockedDatapath* datapath, std::int64_t watchdog_cycles,
                      int framebuffer_cycles = 1) const {
    return run(datapath, watchdog_cycles, framebuffer_cycles).counts.failure;
  }
  Trace run(ClockedDatapath* datapath, std::int64_t watchdog_cycles,
            int framebuffer_cycles = 1) const {
    Random random(71);
    const Scene scene = lit_scene(64, 64);
    const Geometry geometry = random_geometry(random, scene, 30, 15);
    const FrameSetup frame(scene, geometry, small_table());
    PipelineConfiguration pipeline;
    pipeline.span_fifo = 5;
    pipeline.framebuffer_write_cycles = pipeline.framebuffer_test_cycles = framebuffer_cycles;
    SimulationOptions options;
    options.detail = GetParam();
    options.datapath = datapath;
    options.watchdog_cycles = watchdog_cycles;
    return simulate_apart(frame, pipeline, options);
  }
};

void expect_told(const std::string& failure, const std::string& what) {
  EXPECT_NE(failure.find(what), std::string::npos) << "no \"" << what << "\" in: " << failure;
}

TEST_P(Watchdog, ReportsADatapathThatIsNeverReady) {
  NeverReady datapath;
  const std::string message = failure(&datapath, 3000);
  expect_told(message, "nothing has moved for 3000 cycles");
  expect_told(message, "span queue 5 of 5");
  expect_told(message, "framebuffer");
  if (GetParam() == Detail::cycle) {
    expect_told(message, "triangle queue 4 of 4");
    expect_told(message, "pixel queue 0 of 16");
    expect_told(message, "span_walker waiting");
  }
}

TEST_P(Watchdog, ReportsADatapathThatLosesPixels) {
  Swallowing datapath;
  const std::string message = failure(&datapath, 3000);
  expect_told(message, "nothing has moved for 3000 cycles");
  expect_told(message, "pixels in");
}

TEST_P(Watchdog, LeavesASlowPipelineAlone) {
  DatapathRegisters datapath(small_table());
  EXPECT_EQ(failure(&datapath, 3000, 1000), "");
}

TEST_P(Watchdog, SeesAPixelAfterTheLast) {
  DatapathRegisters right(small_table());
  const std::size_t pixels = run(&right, 3000).stream.size();
  ASSERT_GT(pixels, 0U);
  for (const int framebuffer_cycles : {1, 20}) {  // 20: the queue before it is full
    OneTooMany datapath(pixels);
    EXPECT_EQ(run(&datapath, 3000, framebuffer_cycles).stream.size(), pixels + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Pipeline, Watchdog, testing::Values(Detail::span, Detail::cycle),
                         [](const testing::TestParamInfo<Detail>& info) {
                           return info.param == Detail::span ? "BySpan" : "ByCycle";
                         });

}  // namespace
}  // namespace phongpipe
