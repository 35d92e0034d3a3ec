// What each module of the pipeline does in each clock.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "model/shading/fields.h"

namespace phongpipe {

// In the order of the pipeline; between each and the next there is a queue.
enum class Module : std::uint8_t { setup_engine, span_walker, pixel_datapath, framebuffer };
constexpr std::array kModules = {Module::setup_engine, Module::span_walker, Module::pixel_datapath,
                                 Module::framebuffer};
constexpr std::string_view name(Module module) {
  constexpr std::string_view kNames[] = {"setup_engine", "span_walker", "pixel_datapath",
                                         "framebuffer"};
  return kNames[static_cast<std::size_t>(module)];
}

// pixel_datapath is busy in the clocks in which a pixel leaves it; the framebuffer for all cycles
// that a pixel occupies it, those of random back-pressure among them.
enum class ModuleState : std::uint8_t {
  busy,     // with a triangle
  loading,  // a highlight table
  filling,  // or draining: pixel_datapath has work, and no pixel at its output
  stalled,  // by the next module: the queue to it is full
  waiting,  // for the module before: the queue from it is empty
  done      // with the frame
};
constexpr std::size_t kModuleStates = 6;

// Over one frame. Vectors of numbers, which are small in memory and in pipes: there may be
// millions.
struct ModuleActivity {
  // Runs of clocks with the same state and triangle. Each ends where the next one starts, the last
  // one with the frame.
  std::vector<std::int64_t> starts;
  std::vector<ModuleState> states;
  std::vector<std::uint32_t> triangles;  // 0 unless busy
  // Items in the queue before the module, from a cycle on; none for setup_engine.
  std::vector<std::int64_t> fill_cycles;
  std::vector<std::uint32_t> fills;

  static constexpr auto fields() {
    using A = ModuleActivity;
    return std::make_tuple(field("starts", &A::starts), field("states", &A::states),
                           field("triangles", &A::triangles), field("fill_cycles", &A::fill_cycles),
                           field("fills", &A::fills));
  }
};

// A module in the clock that it has told of last.
struct ModuleNow {
  ModuleState state = ModuleState::waiting;
  std::uint32_t triangle = 0;
  std::size_t fill = 0;  // of the queue before it
};

class ActivityRecorder {
 public:
  // Records no more than about `most_events` runs and changes of queues.
  explicit ActivityRecorder(std::size_t most_events) : most_events_(most_events) {}

  // Each module calls it once a clock. `triangle`: with which it is busy. `fill`: of the queue
  // before it.
  void record(Module module, ModuleState state, std::uint32_t triangle, std::size_t fill);
  // The framebuffer has taken the last pixel; later clocks are dropped.
  void finish(std::int64_t frame_cycles);

  const ModuleNow& now(Module module) const { return now_[static_cast<std::size_t>(module)]; }
  bool complete() const { return events_ < most_events_; }  // otherwise the end is missing
  std::vector<ModuleActivity> take() { return std::move(modules_); }  // in the order of kModules

 private:
  std::size_t most_events_;
  std::size_t events_ = 0;
  std::array<std::int64_t, kModules.size()> cycles_ = {};
  std::array<ModuleNow, kModules.size()> now_ = {};
  std::vector<ModuleActivity> modules_ = std::vector<ModuleActivity>(kModules.size());
};

}  // namespace phongpipe
