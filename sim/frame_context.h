// Data shared by all modules of one simulation.
#pragma once

#include <array>
#include <memory>

#include "model/fixed/certificate.h"
#include "model/fixed/front_end.h"
#include "sim/pipeline.h"
#include "sim/schedule.h"
#include "sim/timestamped_fifo.h"

namespace phongpipe {

struct FrameContext {
  const FrameSetup& frame;
  const PipelineConfiguration& configuration;
  const SimulationOptions& options;
  FrontEnd front_end;
  SimulationResult& result;
  SetupTimes setup_times;       // of the setup engine's plans
  std::uint64_t delivered = 0;  // pixels that have left pixel_datapath

  // Sets up the next triangle and adds its cycles to `busy`, which thus also counts triangles left
  // out.
  SetupOutcome set_up(const TriangleOrder& next, TriangleWork& work, Cycle& busy) {
    const SetupOutcome outcome = front_end.set_up(next.triangle(), next.pass(), work);
    if (outcome == SetupOutcome::nothing) return outcome;
    SetupTimes::Cost& cost = setup_times.of(work.setup.plan);
    ++cost.triangles;
    busy += cost.cycles;
    result.setup_cycles += cost.cycles;
    result.setup_cycles_by_path[path_of(frame, work.setup)] +=
        static_cast<std::uint64_t>(cost.cycles);
    result.setup_operations = result.setup_operations + cost.operations;
    return outcome;
  }

  // Cycles the framebuffer spends on a pixel. It takes pixels that arrive side by side at once, in
  // the time of the slowest.
  Cycle framebuffer_cycles(bool first_pass, bool taken) const {
    return !taken       ? configuration.framebuffer_test_cycles
           : first_pass ? configuration.framebuffer_write_cycles
                        : configuration.framebuffer_add_cycles;
  }
  // Counts these cycles, and adds those of random back-pressure at pixel `stream_index` of the
  // stream, the first of those side by side.
  Cycle with_stalls(Cycle cycles, std::uint32_t stream_index) {
    ++result.pixel_groups;
    result.framebuffer_cycles += cycles;
    if (options.stall_percent == 0) return cycles;
    const std::uint32_t random = scramble(stream_index * 2654435769U + options.stall_seed);
    const bool stalled = random % 100 < static_cast<std::uint32_t>(options.stall_percent);
    return cycles + (stalled ? 1 + (random >> 16) % kMostStallCycles : 0);
  }

  void record(const ShadedPixel* pixels, const Cycle* cycles, std::size_t count) {
    result.datapath_cycles = cycles[count - 1] + 1;
    delivered += count;
    if (options.observe) {
      options.observe(pixels, cycles, count);
      return;
    }
    result.stream.insert(result.stream.end(), pixels, pixels + count);
    for (std::size_t i = 0; i < count; ++i) {
      result.pixel_cycles.push_back(static_cast<std::uint32_t>(cycles[i]));
    }
  }
  void record(const ShadedPixel& pixel, Cycle cycle) { record(&pixel, &cycle, 1); }

  // What a module does in this clock, see ActivityRecorder::record().
  void tell(Module module, ModuleState state, std::uint32_t triangle, std::size_t fill) const {
    if (options.activity != nullptr) options.activity->record(module, state, triangle, fill);
  }

 private:
  // A hash of the pixel's index, so that the same pixels stall at every detail and with every
  // datapath. The mixing constants are those of the finaliser of MurmurHash3.
  static std::uint32_t scramble(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x85ebca6bU;
    x ^= x >> 13;
    x *= 0xc2b2ae35U;
    return x ^ (x >> 16);
  }
};

using WorkHandle = std::shared_ptr<const TriangleWork>;

// Pixels side by side on their way to the framebuffer.
struct DepthPixels {
  int count = 0;
  std::array<ShadedPixel, kMostLanes> pixel;
  std::array<std::uint32_t, kMostLanes> depth = {};
  std::uint32_t triangle = 0;
  bool first_pass = true;
};

}  // namespace phongpipe
