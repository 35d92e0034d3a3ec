// What each module of the SystemC pipeline does in each cycle of a frame, and what limits the
// frame.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/activity_recorder.h"
#include "testbench/cosim/verification.h"

namespace phongpipe {

struct Timeline {
  std::int64_t frame_cycles = 0;
  std::vector<ModuleActivity> modules;  // in the order of kModules

  // Calls visit(state, triangle, start, cycles) for each run of a module, in order.
  template <typename Visit>
  void for_each_run(Module module, Visit visit) const {
    const ModuleActivity& activity = modules[static_cast<std::size_t>(module)];
    for (std::size_t i = 0; i < activity.starts.size(); ++i) {
      const std::int64_t start = activity.starts[i];
      const std::int64_t end =
          i + 1 < activity.starts.size() ? activity.starts[i + 1] : frame_cycles;
      visit(activity.states[i], activity.triangles[i], start, end - start);
    }
  }

  static constexpr auto fields() {
    return std::make_tuple(field("frame_cycles", &Timeline::frame_cycles),
                           field("modules", &Timeline::modules));
  }
};

// More would be too much for a browser.
constexpr std::size_t kMostTimelineEvents = 2'000'000;

// Simulates the frame that verify() verifies once more, by the clock. Throws InputError if it has
// more than `most_events` runs and changes of queues.
Timeline record_timeline(const std::shared_ptr<const PreparedScene>& scene,
                         const Hardware& hardware, const VerificationOptions& options,
                         std::size_t most_events = kMostTimelineEvents);

// The cycles that a module spends in each state; their sum is the frame's cycles.
using StateCycles = std::array<std::int64_t, kModuleStates>;
StateCycles state_cycles(const Timeline& timeline, Module module);

// The module that has the most to do: it is busy or loads a table in more cycles than any before
// it, and at least as many as any behind it.
Module limiting_module(const Timeline& timeline);
std::int64_t working_cycles(const StateCycles& cycles);  // busy or loading a table

// A state in words, such as "stalled by span_walker".
std::string state_text(Module module, ModuleState state);

}  // namespace phongpipe
