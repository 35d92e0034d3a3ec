// Waveforms of RTL and SystemC, side by side, of windows of a frame.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "sim/pipeline.h"
#include "testbench/hardware/hardware.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/trace/wave_file.h"

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

// A moment of a trace, for markers in views.
struct TraceMarker {
  std::string name;
  std::int64_t cycle = 0;

  static constexpr auto fields() {
    return std::make_tuple(field("name", &TraceMarker::name), field("cycle", &TraceMarker::cycle));
  }
};

// The windows of the target, in the order of time; those that touch are one. Simulates the frame in
// a child process. Throws InputError if the target is not there, and says what is.
std::vector<CycleWindow> find_windows(const PreparedFrame& frame, const Hardware& hardware,
                                      const TraceTarget& target, const TraceOptions& options);

struct TraceSummary {
  std::vector<TraceMarker> markers;  // entrance and exit of the target's pixels
  std::uint64_t period_ps = 0;
  std::int64_t frame_cycles = 0;
  std::uint64_t stream_hash = 0;  // of all pixels of the frame and their cycles

  static constexpr auto fields() {
    using T = TraceSummary;
    return std::make_tuple(field("markers", &T::markers), field("period_ps", &T::period_ps),
                           field("frame_cycles", &T::frame_cycles),
                           field("stream_hash", &T::stream_hash));
  }
};
struct RecordedTrace : TraceSummary {
  std::vector<WaveVariable> variables;  // in the order of the file
};

// Simulates the frame clock by clock in a child process, with SystemC and RTL in parallel, and
// writes the windows to `file`. `library` was built with signals. Cycle k is shown from k to k + 1
// clock periods; between windows all words are x.
RecordedTrace record_trace(const PreparedFrame& frame, const Hardware& hardware,
                           const RtlLibrary& library, const std::vector<CycleWindow>& windows,
                           const TraceTarget& target, const TraceOptions& options,
                           const std::filesystem::path& file);

// The variables of every trace of this hardware, in the order of the file.
std::vector<WaveVariable> trace_variables(const DatapathConfiguration& configuration,
                                          const RtlLibrary& library);

}  // namespace phongpipe
