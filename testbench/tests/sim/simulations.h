// Simulations in processes of their own, since SystemC elaborates once a process.
#pragma once

#include <string>
#include <vector>

#include "sim/pipeline.h"
#include "testbench/system/process.h"
#include "testbench/system/random.h"
#include "testbench/system/record_json.h"

namespace phongpipe {

// A simulation with every pixel and its cycle, as it travels between processes.
struct Trace {
  SimulationCounts counts;
  std::vector<ShadedPixel> stream;
  std::vector<std::uint32_t> cycles;  // of each pixel
  std::vector<std::uint32_t> colors;  // of the image at the end

  static constexpr auto fields() {
    using T = Trace;
    return std::make_tuple(field("counts", &T::counts), field("stream", &T::stream),
                           field("cycles", &T::cycles), field("colors", &T::colors));
  }
};

inline Trace trace_of(const SimulationResult& result) {
  Trace trace{result, result.stream, result.pixel_cycles, {}};
  for (std::size_t i = 0; i < result.framebuffer.size(); ++i) {
    trace.colors.push_back(result.framebuffer.color(i));
  }
  return trace;
}

inline Trace simulate_apart(const FrameSetup& frame, const PipelineConfiguration& configuration,
                            const SimulationOptions& options) {
  Child child([&] { return to_bytes(trace_of(simulate(frame, configuration, options))); });
  return from_bytes<Trace>(child.get());
}

inline PipelineConfiguration random_pipeline(Random& random) {
  PipelineConfiguration c;
  c.triangle_fifo = random.integer(1, 8);
  c.span_fifo = random.integer(1, 8);
  c.pixel_fifo = random.integer(1, 8);
  c.walker_triangle_cycles = random.integer(1, 4);
  c.walker_row_cycles = random.integer(1, 4);
  c.framebuffer_write_cycles = random.integer(1, 4);
  c.framebuffer_test_cycles = random.integer(1, 4);
  c.framebuffer_add_cycles = random.integer(1, 4);
  const auto units = [&random] { return Units{random.integer(1, 16), random.integer(1, 3), 1}; };
  c.adders = units();
  c.multipliers = units();
  c.rsqrt = units();
  return c;
}

}  // namespace phongpipe
