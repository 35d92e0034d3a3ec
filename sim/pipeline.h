// The SystemC pipeline: setup_engine, span_walker, pixel_datapath and framebuffer, joined by
// bounded queues with back-pressure, over one frame.
//
//   by_span   modules run ahead of the kernel and keep time in timestamped queues
//   by_clock  every module acts in every clock
//
// Both give the same cycle for every pixel. Cycle 0 is the first cycle of the first triangle's
// setup.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/fixed/framebuffer.h"
#include "model/fixed/shading_path.h"
#include "model/shading/dataflow.h"
#include "sim/activity_recorder.h"
#include "sim/clocked_datapath.h"
#include "sim/datapath_blocks.h"
#include "sim/pipeline_configuration.h"

namespace phongpipe {

enum class Detail { span, cycle };

constexpr int kMostStallCycles = 8;

struct SimulationOptions {
  Detail detail = Detail::span;
  // The implementation behind the ports of pixel_datapath; null: the SystemC module's own values.
  ClockedDatapath* datapath = nullptr;
  // Random back-pressure: the framebuffer takes 1 to kMostStallCycles cycles more for this share of
  // pixels.
  int stall_percent = 0;
  std::uint32_t stall_seed = 1;
  // Called with the pixels as they leave pixel_datapath, and the cycle of each. The result then
  // does not record them.
  std::function<void(const ShadedPixel* pixels, const std::int64_t* cycles, std::size_t count)>
      observe;
  // Told what each module does in each clock, if not null; by Detail::cycle only.
  ActivityRecorder* activity = nullptr;
  // The pipeline counts as stuck if nothing has moved for this many cycles.
  std::int64_t watchdog_cycles = 1'000'000;
};

// How often the setup engine carried out a plan.
struct SetupUse {
  SeriesPlan plan;
  std::uint64_t triangles = 0;

  static constexpr auto fields() {
    using U = SetupUse;
    return std::make_tuple(field("plan", &U::plan), field("triangles", &U::triangles));
  }
};

// Counts of one simulation.
struct SimulationCounts {
  std::int64_t frame_cycles = 0;     // until the framebuffer has taken the last pixel
  std::int64_t datapath_cycles = 0;  // until pixel_datapath has delivered the last pixel
  std::int64_t setup_cycles = 0;     // in which the setup engine was busy
  Ledger setup_cycles_by_path;       // the same cycles
  std::vector<SetupUse> setup_uses;
  std::int64_t exact_path_cycles = 0;  // in which exact_path was busy
  OperationCounts exact_path_operations;
  std::int64_t pixel_groups = 0;  // of pixels that pixel_datapath delivered together
  // In which span_walker and framebuffer were busy with triangles and pixels, waits not included.
  std::int64_t walker_cycles = 0, framebuffer_cycles = 0;
  std::int64_t rom_load_cycles = 0;
  // Cycles in which a ClockedDatapath held a pixel or was offered a span; 0 by_span without a
  // ClockedDatapath.
  std::int64_t datapath_busy_cycles = 0;
  OperationCounts setup_operations;
  PixelOperations pixel_operations;  // not counted by_span with a ClockedDatapath
  std::uint64_t depth_additions = 0;
  std::vector<std::string> modules;  // hierarchical names of the elaborated modules
  std::string failure;               // why the simulation stopped early, and its state; else empty

  static constexpr auto fields() {
    using C = SimulationCounts;
    return std::make_tuple(
        field("frame_cycles", &C::frame_cycles), field("datapath_cycles", &C::datapath_cycles),
        field("setup_cycles", &C::setup_cycles),
        field("setup_cycles_by_path", &C::setup_cycles_by_path),
        field("setup_uses", &C::setup_uses), field("exact_path_cycles", &C::exact_path_cycles),
        field("exact_path_operations", &C::exact_path_operations),
        field("pixel_groups", &C::pixel_groups), field("walker_cycles", &C::walker_cycles),
        field("framebuffer_cycles", &C::framebuffer_cycles),
        field("rom_load_cycles", &C::rom_load_cycles),
        field("datapath_busy_cycles", &C::datapath_busy_cycles),
        field("setup_operations", &C::setup_operations),
        field("pixel_operations", &C::pixel_operations),
        field("depth_additions", &C::depth_additions), field("modules", &C::modules),
        field("failure", &C::failure));
  }
};

struct SimulationResult : SimulationCounts {
  explicit SimulationResult(const FrameSetup& frame) : framebuffer(frame) {}

  // The pixels as they leave pixel_datapath, and the cycle of each; empty with options.observe.
  std::vector<ShadedPixel> stream;
  std::vector<std::uint32_t> pixel_cycles;
  Framebuffer framebuffer;  // at the end
};

// Simulates one frame. SystemC elaborates once per process: a second call throws std::logic_error.
SimulationResult simulate(const FrameSetup& frame, const PipelineConfiguration& configuration,
                          const SimulationOptions& options);

// Cycles from a pixel that leaves pixel_datapath to the next one while that waits for the
// framebuffer, at most. If it is 1, none waits: each leaves `latency_cycles()` after it entered.
int slowest_output_cycles(const PipelineConfiguration& configuration,
                          const SimulationOptions& options);

// Ends the simulation soon; for `observe` and for a ClockedDatapath, which may be called some more.
void stop_simulation();

}  // namespace phongpipe
