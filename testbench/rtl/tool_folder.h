// Folders in which tools work: Verilator and g++, yosys and nextpnr, GTKWave's library.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "testbench/system/process.h"

namespace phongpipe {

// The RTL source files in a folder, .sv and .svh, sorted, without subfolders. Throws InputError if
// there is no .sv file.
std::vector<std::filesystem::path> rtl_sources(const std::filesystem::path& folder);

// A copy of the user's file, under a name that no tool mangles.
struct RtlSource {
  std::string copy;  // relative to the folder of the tools
  std::filesystem::path original;
};

// Goes away with its contents; folders of processes that were killed are swept.
class ToolFolder {
 public:
  static constexpr std::string_view kSources = "rtl";  // the folder in it with copies of RTL

  // Throws ToolError if there can be none.
  explicit ToolFolder(const std::filesystem::path& beside);
  ~ToolFolder();
  ToolFolder(const ToolFolder&) = delete;
  ToolFolder& operator=(const ToolFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::vector<RtlSource> copy_sources(const std::filesystem::path& folder) const;
  // Runs a tool in the folder, with limits of memory and time. Throws ToolError if it cannot be
  // started; `otherwise` says what else than installing it would help.
  ProcessOutput run(const std::vector<std::string>& command, std::string_view otherwise = {}) const;

 private:
  std::filesystem::path path_;
};

}  // namespace phongpipe
