#include "testbench/rtl/rtl_builder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstring>
#include <set>
#include <string>
#include <string_view>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/system/installation.h"
#include "testbench/system/process.h"
#include "testbench/system/terminal.h"
#include "testbench/system/tool_error.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// The parameters of the RTL as options of a tool: prefix, name, = and value.
std::vector<std::string> parameter_options(std::string_view prefix,
                                           const DatapathConfiguration& configuration) {
  std::vector<std::string> options;
  for (const auto& [name, value] : rtl_parameters(configuration)) {
    options.push_back(fmt::format("{}{}={}", prefix, name, value));
  }
  return options;
}

bool starts_with(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

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

// A folder of our own that goes away with its contents.
class ScratchFolder {
 public:
  explicit ScratchFolder(const fs::path& beside) {
    std::error_code error;
    fs::create_directories(beside, error);
    std::string name = (beside / fmt::format("{}{}-XXXXXX", scratch_prefix(), getpid())).string();
    if (!error && mkdtemp(name.data()) == nullptr) {
      error = std::error_code(errno, std::generic_category());
    }
    if (error) {
      throw ToolError(
          fmt::format("{}: RTL cannot be built there: {}; XDG_CACHE_HOME can name "
                      "another folder",
                      printable(beside.string()), std::strerror(error.value())));
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// A copy of the user's file, under a name that no tool mangles.
struct Source {
  std::string copy;  // relative to the scratch folder
  fs::path original;
};

std::vector<Source> copy_sources(const fs::path& folder, const fs::path& scratch) {
  const fs::path copies = "rtl";
  fs::create_directory(scratch / copies);
  std::vector<Source> sources;
  std::set<std::string> names;
  for (const fs::path& file : rtl_sources(folder)) {
    std::string name = file.filename().string();
    if (file.extension() == ".sv") {  // what is included keeps the name it is included by
      std::replace_if(
          name.begin(), name.end(),
          [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '.'; }, '_');
    }
    while (!names.insert(name).second) name.insert(0, "_");
    fs::copy_file(file, scratch / copies / name);
    sources.push_back({copies / name, file});
  }
  return sources;
}

// The line that says what is wrong, of all that a tool prints. Verilator's warnings are errors, and
// the last error it prints only counts them; g++ ends with what its linker ended with.
std::string first_complaint(const std::string& text) {
  std::string first;
  std::string_view line;
  for (LineReader lines(text); lines.next(line);) {
    if (starts_with(line, "%Error: Exiting due to") || starts_with(line, "collect2:")) continue;
    if (starts_with(line, "%Warning-") || starts_with(line, "%Error") ||
        line.find("error:") != std::string_view::npos) {
      return std::string(line);
    }
    if (first.empty()) first = trimmed(line);
  }
  return first;
}

ProcessOutput run_installed(const std::vector<std::string>& command, const fs::path& folder) {
  ProcessOutput output = run_process(command, folder);
  const std::string& tool = command.front();
  // EACCES: a folder of PATH is closed to us, as root's often is.
  if (output.start_error == ENOENT || output.start_error == EACCES) {
    throw ToolError(
        fmt::format("{} is not installed; install the package {}, or choose a "
                    "configuration that is built beforehand, such as a preset as it is",
                    tool, tool));
  }
  if (output.start_error != 0) {
    throw ToolError(
        fmt::format("{} cannot be started: {}", tool, std::strerror(output.start_error)));
  }
  return output;
}

// Returns what the tool prints. Complaints name the user's files.
std::string run_or_throw(const std::vector<std::string>& command, const fs::path& folder,
                         const std::vector<Source>& sources) {
  const ProcessOutput output = run_installed(command, folder);
  if (output.status == 0) return output.text;
  std::string complaint = first_complaint(output.text);
  for (const Source& source : sources) {
    const std::size_t at = complaint.find(source.copy + ":");
    if (at == std::string::npos) continue;
    complaint.replace(at, source.copy.size(), source.original.string());
    break;
  }
  if (complaint.empty()) complaint = fmt::format("nothing, and ended with {}", output.status);
  throw ToolError(
      fmt::format("building the RTL failed: {} said: {}", command.front(), printable(complaint)));
}

std::string verilator_include(const fs::path& folder) {
  const std::string text = run_or_throw({"verilator", "--getenv", "VERILATOR_ROOT"}, folder, {});
  std::string root;
  std::string_view line;
  for (LineReader lines(text); lines.next(line);) {  // the last line, after any warnings
    if (!line.empty()) root = line;
  }
  return root + "/include";
}

void append(std::vector<std::string>& command, const std::vector<std::string>& words) {
  command.insert(command.end(), words.begin(), words.end());
}

}  // namespace

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

// The tools run in the scratch folder and get only names relative to it, or of the installation:
// Verilator is a Perl script that mangles others.
void build_rtl(const DatapathConfiguration& configuration, const fs::path& sources_folder,
               const fs::path& library) try {
  const fs::path destination = fs::absolute(library).parent_path();
  sweep_abandoned(destination);
  const ScratchFolder scratch(destination);
  const fs::path& folder = scratch.path();
  const std::string include = verilator_include(folder);
  const std::vector<Source> sources = copy_sources(sources_folder, folder);

  std::vector<std::string> verilate = {"verilator",    "--cc",
                                       "-O3",          "-Wall",
                                       "--Mdir",       ".",
                                       "--prefix",     "Vpixel_datapath",
                                       "--top-module", "pixel_datapath",
                                       "-Irtl"};
  append(verilate, parameter_options("-G", configuration));
  for (const Source& source : sources) {
    if (source.original.extension() == ".sv") verilate.push_back(source.copy);
  }
  run_or_throw(verilate, folder, sources);

  const fs::path& shim = installation().rtl_shim;
  std::vector<std::string> compile = {"g++",
                                      "-std=c++17",
                                      "-O3",
                                      "-fPIC",
                                      "-shared",
                                      "-fvisibility=hidden",
                                      "-I" + include,
                                      "-I" + include + "/vltstd",
                                      "-I.",
                                      "-I" + shim.string(),
                                      "-I" + installation().include.string()};
  append(compile, parameter_options("-DPHONGPIPE_", configuration));
  compile.push_back((shim / "rtl_shim.cpp").string());
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".cpp") compile.push_back(entry.path().filename().string());
  }
  const std::string built = "pixel_datapath.so";
  append(compile, {(installation().libraries / "libphongpipe_verilated.a").string(), "-pthread",
                   "-o", built});
  run_or_throw(compile, folder, sources);
  fs::rename(folder / built, library);
} catch (const fs::filesystem_error& error) {
  throw ToolError(fmt::format("{}: building the RTL failed: {}", printable(library.string()),
                              error.code().message()));
}

}  // namespace phongpipe
