#include "testbench/rtl/tool_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <set>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// Folders of this machine that are still built in, or were when a process was killed, are called
// build-MACHINE-PROCESS-NUMBER; several machines may share a cache.
std::string scratch_prefix() {
  std::array<char, HOST_NAME_MAX + 1> machine{};
  gethostname(machine.data(), machine.size() - 1);
  return fmt::format("build-{}-", machine.data());
}

void sweep_abandoned(const fs::path& beside) {
  const std::string prefix = scratch_prefix();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(beside, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!starts_with(name, prefix)) continue;
    pid_t process = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, process);
    if (error != std::errc() || rest == end || *rest != '-' || process <= 0) continue;
    if (kill(process, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

ToolFolder::ToolFolder(const fs::path& beside) {
  sweep_abandoned(beside);
  std::error_code error;
  fs::create_directories(beside, error);
  std::string name = (beside / fmt::format("{}{}-XXXXXX", scratch_prefix(), getpid())).string();
  if (!error && mkdtemp(name.data()) == nullptr) {
    error = std::error_code(errno, std::generic_category());
  }
  if (error) {
    throw ToolError(fmt::format(
        "{}: no folder can be made there: {}; XDG_CACHE_HOME names the one for RTL that "
        "is built, TMPDIR for RTL that is synthesised",
        printable(beside.string()), std::strerror(error.value())));
  }
  path_ = name;
}

ToolFolder::~ToolFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<RtlSource> ToolFolder::copy_sources(const fs::path& folder) const {
  const fs::path copies = kSources;
  fs::create_directory(path_ / copies);
  std::vector<RtlSource> sources;
  std::set<std::string> names;
  for (const fs::path& file : rtl_sources(folder)) {
    std::string name = file.filename().string();
    if (file.extension() == ".sv") {  // what is included keeps the name it is included by
      std::replace_if(
          name.begin(), name.end(),
          [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '.'; }, '_');
    }
    while (!names.insert(name).second) name.insert(0, "_");
    fs::copy_file(file, path_ / copies / name);
    sources.push_back({copies / name, file});
  }
  return sources;
}

ProcessOutput ToolFolder::run(const std::vector<std::string>& command,
                              std::string_view otherwise) const {
  // Verilator would read a device that a source includes, and never end.
  constexpr ProcessLimits kLimits = {std::uint64_t{8} << 30, 1200};
  ProcessOutput output = run_process(command, path_, kLimits);
  const std::string& tool = command.front();
  // EACCES: a folder of PATH is closed to us, as root's often is.
  if (output.start_error == ENOENT || output.start_error == EACCES) {
    throw ToolError(
        fmt::format("{} is not installed; install the package {}{}", tool, tool, otherwise));
  }
  if (output.start_error != 0) {
    throw ToolError(
        fmt::format("{} cannot be started: {}", tool, std::strerror(output.start_error)));
  }
  return output;
}

std::vector<fs::path> rtl_sources(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto extension = entry.path().extension();
    if (extension == ".sv" || extension == ".svh") files.push_back(entry.path());
  }
  if (error) {
    throw InputError(fmt::format("{}: {}", printable(folder.string()), error.message()));
  }
  if (std::none_of(files.begin(), files.end(),
                   [](const fs::path& file) { return file.extension() == ".sv"; })) {
    throw InputError(fmt::format("{}: no RTL here, which is in files that end with .sv",
                                 printable(folder.string())));
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace phongpipe
