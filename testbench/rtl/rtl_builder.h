// Builds the Verilated pixel_datapath of one configuration as a shared library, with Verilator and
// g++.
#pragma once

#include <filesystem>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// The files of a folder that RTL is built from, sorted: .sv and .svh, not those of subfolders.
// Throws InputError where there is no .sv.
std::vector<std::filesystem::path> rtl_sources(const std::filesystem::path& folder);

// Makes `library` of the sources in a folder; it appears whole or not at all, also where two build
// at once. Any paths will do. Throws ToolError with the first complaint of the tool that failed.
void build_rtl(const DatapathConfiguration& configuration, const std::filesystem::path& sources,
               const std::filesystem::path& library);

}  // namespace phongpipe
