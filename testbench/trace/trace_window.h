// The part of a frame that a trace shows: what is asked for, and the cycles in which it happens.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "model/shading/fields.h"
#include "sim/pipeline.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {

// Cycles of the frame, both included.
struct CycleWindow {
  std::int64_t first = 0, last = 0;

  static constexpr auto fields() {
    return std::make_tuple(field("first", &CycleWindow::first), field("last", &CycleWindow::last));
  }
};

// What to record. Exactly one of `pixels`, `triangle`, `span`, `cycles` and `frame` is set.
struct TraceTarget {
  std::vector<std::array<int, 2>> pixels;  // x, y; each time that one is shaded is a window
  std::optional<std::uint32_t> triangle;   // of the scene
  std::optional<std::uint64_t> span;       // counted from 0 as they enter pixel_datapath
  std::optional<CycleWindow> cycles;
  bool frame = false;
  int margin_cycles = 32;  // before and after
};

struct TraceOptions {
  SimulationOptions simulation;  // back-pressure
  // Whether the RTL answers to the other modules, as when it is verified, or only follows SystemC.
  bool rtl_drives = false;
};

// The windows of the target, in the order of time; those that touch are one. Simulates the frame in
// a child process. Throws InputError if the target is not there, and says what is.
std::vector<CycleWindow> find_windows(const PreparedFrame& frame, const Hardware& hardware,
                                      const TraceTarget& target, const TraceOptions& options);

}  // namespace phongpipe
