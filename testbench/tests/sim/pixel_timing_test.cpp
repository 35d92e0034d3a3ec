// The closed form of time between pixel_datapath and framebuffer, against the clocked datapath, a
// registered queue and a framebuffer executed clock by clock.
#include "sim/pixel_timing.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "sim/datapath_registers.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kPixelTimingSeed = 47;

struct Arrival {
  int length;
  Cycle asked;               // from which the span may enter
  std::vector<Cycle> costs;  // of each pixel, in the framebuffer
};

struct Times {
  std::vector<Cycle> in;   // of each span
  std::vector<Cycle> out;  // of each pixel
  Cycle end = 0;
};

Times closed_form(const DatapathConfiguration& datapath, const std::vector<Arrival>& arrivals,
                  int depth) {
  Times times;
  PixelTiming timing(datapath, depth);
  for (const Arrival& arrival : arrivals) {
    std::vector<Cycle> cycles = arrival.costs;
    times.in.push_back(timing.next(arrival.asked, cycles.size(), cycles.data()));
    times.out.insert(times.out.end(), cycles.begin(), cycles.end());
    EXPECT_EQ(timing.out(), cycles.back());
  }
  times.end = timing.end();
  return times;
}

Times clock_by_clock(const DatapathConfiguration& configuration,
                     const std::vector<Arrival>& arrivals, int depth) {
  Times times;
  DatapathRegisters datapath(configuration);
  HighlightTable table;
  table.roms.emplace_back(configuration, 0.5, 20);
  DatapathInputs load;
  load.table = &table;
  load.rom_address = configuration.rom_words() - 1;
  datapath.clock(load);

  std::vector<Cycle> costs;
  for (const Arrival& arrival : arrivals) {
    costs.insert(costs.end(), arrival.costs.begin(), arrival.costs.end());
  }
  std::size_t read = 0, queued = 0;  // pixels the framebuffer has read; that wait for it
  Cycle busy = 0;
  for (Cycle cycle = 0; read < costs.size(); ++cycle) {
    const bool full = queued == static_cast<std::size_t>(depth), empty = queued == 0;
    Span span;
    DatapathInputs inputs;
    inputs.pixel_ready = !full;
    const std::size_t next = times.in.size();
    if (next < arrivals.size() && arrivals[next].asked <= cycle) {
      // Of a wide datapath, what is timed are the groups of pixels that leave together.
      span.row = {0, 0, arrivals[next].length * configuration.lanes()};
      inputs.span = &span;
    }
    const DatapathOutputs outputs = datapath.clock(inputs);
    if (inputs.span != nullptr && outputs.span_ready) times.in.push_back(cycle);
    if (outputs.pixel_valid && !full) {
      times.out.push_back(cycle);
      ++queued;
    }
    if (busy > 0) --busy;
    if (busy > 0 || empty) continue;
    busy = costs[read++];
    --queued;
    times.end = cycle + busy;
  }
  return times;
}

void expect_same_times(const DatapathConfiguration& datapath, const std::vector<Arrival>& arrivals,
                       int depth) {
  const Times fast = closed_form(datapath, arrivals, depth);
  const Times slow = clock_by_clock(datapath, arrivals, depth);
  EXPECT_EQ(fast.in, slow.in);
  EXPECT_EQ(fast.out, slow.out);
  EXPECT_EQ(fast.end, slow.end);
}

TEST(PixelTiming, IsThatOfEveryClock) {
  SCOPED_TRACE(kPixelTimingSeed);
  Random random(kPixelTimingSeed);
  for (int i = 0; i < 500; ++i) {
    std::vector<Arrival> arrivals;
    const int spans = random.integer(1, 30), longest = random.integer(1, 20);
    const int pause = random.integer(0, 30), dearest = random.integer(1, 6);
    Cycle asked = 0;
    for (int k = 0; k < spans; ++k) {
      Arrival arrival;
      arrival.length = random.integer(1, longest);
      arrival.asked = asked += random.integer(0, pause);
      const int dearest_here = random.integer(0, 1) == 0 ? 1 : dearest;
      for (int p = 0; p < arrival.length; ++p) {
        arrival.costs.push_back(random.integer(1, dearest_here));
      }
      arrivals.push_back(arrival);
    }
    const int depth = random.integer(1, 20);
    DatapathConfiguration datapath;
    datapath.kind = kDatapathKinds[random.below(kDatapathKinds.size())].kind;
    datapath.diffuse_fraction_bits = random.integer(4, 30);
    datapath.depth_cue = random.integer(0, 1) == 0;
    datapath.specular = random.integer(0, 1) == 0;
    expect_same_times(datapath, arrivals, depth);
    if (testing::Test::HasFailure()) FAIL() << "case " << i << ", queue of " << depth;
  }
}

TEST(PixelTiming, ByHand) {
  PixelTiming timing(DatapathConfiguration{}, 2);
  std::vector<Cycle> cycles = {1, 100, 1, 1, 1};  // in the framebuffer
  EXPECT_EQ(timing.next(10, 5, cycles.data()), 10);
  const Cycle first = 10 + kDatapathLatency;
  // The framebuffer reads the first in the clock after it left, for one clock; the second for 100.
  // Two pixels wait meanwhile, and the fifth leaves in the clock after the third is read.
  const Cycle third_read = first + 2 + 100;
  EXPECT_EQ(cycles, (std::vector<Cycle>{first, first + 1, first + 2, first + 3, third_read + 1}));
  EXPECT_EQ(timing.end(), third_read + 3);
}

}  // namespace
}  // namespace phongpipe
