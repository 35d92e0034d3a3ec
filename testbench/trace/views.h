// Views of a trace: a save file for GTKWave and a command file for Surfer.
#pragma once

#include <filesystem>
#include <string>

#include "testbench/trace/wave_trace.h"

namespace phongpipe {

// Signals grouped by implementation and block, words with their binary point, markers of the
// trace, and the window in view. To be written beside the trace.
std::string gtkwave_view(const RecordedTrace& trace, const CycleWindow& shown,
                         const std::filesystem::path& trace_file);
std::string surfer_view(const RecordedTrace& trace);

}  // namespace phongpipe
