// Waveforms of RTL and SystemC, side by side, of windows of a frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "testbench/hardware/hardware.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/trace/trace_window.h"
#include "testbench/trace/wave_file.h"

namespace phongpipe {

// A moment of a trace, for markers in views.
struct TraceMarker {
  std::string name;
  std::int64_t cycle = 0;

  static constexpr auto fields() {
    return std::make_tuple(field("name", &TraceMarker::name), field("cycle", &TraceMarker::cycle));
  }
};

struct TraceSummary {
  std::vector<TraceMarker> markers;  // entrance and exit of the target's pixels
  std::uint64_t period_ps = 0;
  std::int64_t frame_cycles = 0;
  std::uint64_t stream_hash = 0;  // of all pixels of the frame and their cycles
  std::string failure;            // why the simulation ended before the frame's end, if it did

  static constexpr auto fields() {
    using T = TraceSummary;
    return std::make_tuple(field("markers", &T::markers), field("period_ps", &T::period_ps),
                           field("frame_cycles", &T::frame_cycles),
                           field("stream_hash", &T::stream_hash), field("failure", &T::failure));
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

}  // namespace phongpipe
