#include "sim/activity_recorder.h"

namespace phongpipe {

void ActivityRecorder::record(Module module, ModuleState state, std::uint32_t triangle,
                              std::size_t fill) {
  const auto index = static_cast<std::size_t>(module);
  const std::int64_t cycle = cycles_[index]++;
  now_[index] = {state, triangle, fill};
  if (!complete()) return;
  ModuleActivity& activity = modules_[index];
  if (state != ModuleState::busy) triangle = 0;
  if (activity.starts.empty() || activity.states.back() != state ||
      activity.triangles.back() != triangle) {
    activity.starts.push_back(cycle);
    activity.states.push_back(state);
    activity.triangles.push_back(triangle);
    ++events_;
  }
  const auto items = static_cast<std::uint32_t>(fill);
  if (module != Module::setup_engine &&
      (activity.fills.empty() || activity.fills.back() != items)) {
    activity.fill_cycles.push_back(cycle);
    activity.fills.push_back(items);
    ++events_;
  }
}

void ActivityRecorder::finish(std::int64_t frame_cycles) {
  for (ModuleActivity& activity : modules_) {
    while (!activity.starts.empty() && activity.starts.back() >= frame_cycles) {
      activity.starts.pop_back();
      activity.states.pop_back();
      activity.triangles.pop_back();
    }
    while (!activity.fill_cycles.empty() && activity.fill_cycles.back() >= frame_cycles) {
      activity.fill_cycles.pop_back();
      activity.fills.pop_back();
    }
    // What it waits for until the end never comes.
    if (!activity.states.empty() && activity.states.back() == ModuleState::waiting) {
      activity.states.back() = ModuleState::done;
    }
  }
}

}  // namespace phongpipe
