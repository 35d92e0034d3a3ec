// Builds the Verilated pixel_datapath of one configuration as a shared library, with Verilator and
// g++.
#pragma once

#include <filesystem>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// The RTL source files in a folder, .sv and .svh, sorted, without subfolders. Throws InputError if
// there is no .sv file.
std::vector<std::filesystem::path> rtl_sources(const std::filesystem::path& folder);

// Builds `library` from the sources in a folder. The file appears whole or not at all, even if two
// processes build it at once. Any characters in paths are allowed. Throws ToolError with the first
// error message of the tool that failed.
void build_rtl(const DatapathConfiguration& configuration, const std::filesystem::path& sources,
               const std::filesystem::path& library);

}  // namespace phongpipe
