#include "testbench/trace/timeline.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

Module next(Module module) {
  return static_cast<Module>(static_cast<int>(module) + 1);
}
Module before(Module module) {
  return static_cast<Module>(static_cast<int>(module) - 1);
}

}  // namespace

Timeline record_timeline(const std::shared_ptr<const PreparedScene>& scene,
                         const Hardware& hardware, const VerificationOptions& options,
                         std::size_t most_events) {
  const PreparedFrame frame(scene, hardware.formats, hardware.setup, simulated_effects(options));
  Child child([&] {
    ActivityRecorder recorder(most_events);
    SimulationOptions simulation = simulation_options(options);
    simulation.detail = Detail::cycle;
    simulation.activity = &recorder;
    simulation.observe = [](const ShadedPixel*, const std::int64_t*, std::size_t) {};
    const SimulationResult result = simulate(frame.setup, hardware.pipeline, simulation);
    if (!result.failure.empty()) throw ToolError("the timeline: " + result.failure);
    if (!recorder.complete()) {
      throw InputError(fmt::format(
          "{}: the timeline of {} cycles has more than {} events; make the image smaller, such as "
          "by --set scene.image.width={} --set scene.image.height={}",
          scene->scene.source, result.frame_cycles, most_events, frame.setup.width / 2,
          frame.setup.height / 2));
    }
    return to_bytes(Timeline{result.frame_cycles, recorder.take()});
  });
  auto timeline = from_bytes<Timeline>(child.get());
  for (ModuleActivity& activity : timeline.modules) {
    for (std::size_t i = 0; i < activity.triangles.size(); ++i) {
      std::uint32_t& triangle = activity.triangles[i];
      if (activity.states[i] == ModuleState::busy) triangle = frame.subdivision().whole[triangle];
    }
  }
  return timeline;
}

StateCycles state_cycles(const Timeline& timeline, Module module) {
  StateCycles sums = {};
  timeline.for_each_run(
      module, [&sums](ModuleState state, std::uint32_t, std::int64_t, std::int64_t cycles) {
        sums[static_cast<std::size_t>(state)] += cycles;
      });
  return sums;
}

std::int64_t working_cycles(const StateCycles& cycles) {
  return cycles[static_cast<std::size_t>(ModuleState::busy)] +
         cycles[static_cast<std::size_t>(ModuleState::loading)];
}

Module limiting_module(const Timeline& timeline) {
  Module limiting = Module::setup_engine;
  std::int64_t most = -1;
  for (const Module module : kModules) {
    const std::int64_t cycles = working_cycles(state_cycles(timeline, module));
    if (cycles > most) limiting = module;
    most = std::max(most, cycles);
  }
  return limiting;
}

std::string state_text(Module module, ModuleState state) {
  switch (state) {
    case ModuleState::busy:
      return "busy";
    case ModuleState::loading:
      return "loading the table";
    case ModuleState::filling:
      return "filling or draining";
    case ModuleState::stalled:
      return fmt::format("stalled by {}", name(next(module)));
    case ModuleState::waiting:
      return fmt::format("waiting for {}", name(before(module)));
    case ModuleState::done:
      break;
  }
  return "done";
}

}  // namespace phongpipe
