// Builds the Verilated pixel_datapath of one or more configurations as a shared library, with
// Verilator and g++.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// The RTL of one configuration and the file that it is to be found in.
struct RtlTarget {
  DatapathConfiguration configuration;
  std::filesystem::path file;
};

// Builds one library with all targets, which must be in one folder and have different parameters,
// from the sources in a folder; each target's file is a link to it. A target that is built with 15
// others takes a quarter of the time that it takes alone. Files appear whole or not at all, even if
// two processes build them at once. Any characters in paths are allowed. Throws ToolError with the
// first error message of the tool that failed.
enum class RtlBuild {
  fast,     // simulates fast
  quick,    // compiled in two thirds of the time to what simulates at two thirds of the speed
  signals,  // with RtlInterface::visit_signals; simulates at a third of the speed
};
void build_rtl(const std::vector<RtlTarget>& targets, const std::filesystem::path& sources,
               RtlBuild build = RtlBuild::fast);

}  // namespace phongpipe
