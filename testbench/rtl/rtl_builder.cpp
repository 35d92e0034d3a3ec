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
#include "model/scene/tool_error.h"
#include "testbench/rtl/rtl_cache.h"
#include "testbench/system/installation.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

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
  // Verilator would read a device that a source includes, and never end.
  constexpr ProcessLimits kLimits = {std::uint64_t{8} << 30, 1200};
  ProcessOutput output = run_process(command, folder, kLimits);
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

// The prefix of what Verilator generates for target i. None is the beginning of another's files.
std::string variant_name(std::size_t i) {
  return fmt::format("Vpixel_datapath_{}", i);
}

void verilate(const DatapathConfiguration& configuration, const std::string& prefix,
              const std::vector<Source>& sources, const fs::path& folder, RtlBuild build) {
  std::vector<std::string> command = {
      "verilator", "--cc", "-O3",          "-Wall",          "--Mdir", ".",
      "--prefix",  prefix, "--top-module", "pixel_datapath", "-Irtl"};
  if (build == RtlBuild::signals) {
    command.insert(command.end(), {"--public-flat-rw", "--vpi"});
  }
  for (const auto& [name, value] : rtl_parameters(configuration)) {
    command.push_back(fmt::format("-G{}={}", name, value));
  }
  for (const Source& source : sources) {
    if (source.original.extension() == ".sv") command.push_back(source.copy);
  }
  run_or_throw(command, folder, sources);
}

// The .cpp files that Verilator made for a prefix, sorted.
std::vector<fs::path> generated_files(const fs::path& folder, const std::string& prefix) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".cpp" || !starts_with(name, prefix)) continue;
    const char next = name[prefix.size()];
    if (next == '.' || next == '_') files.push_back(entry.path().filename());
  }
  std::sort(files.begin(), files.end());
  return files;
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
// Verilator is a Perl script that mangles others. All that it generates is compiled as one file,
// for most of the time of a file goes into headers.
void build_rtl(const std::vector<RtlTarget>& targets, const fs::path& sources_folder,
               RtlBuild build) try {
  const fs::path destination = fs::absolute(targets.front().file).parent_path();
  sweep_abandoned(destination);
  const ScratchFolder scratch(destination);
  const fs::path& folder = scratch.path();
  const std::string include = verilator_include(folder);
  const std::vector<Source> sources = copy_sources(sources_folder, folder);
  std::string unity, choice;
  if (build == RtlBuild::signals) unity += "#define PHONGPIPE_RTL_SIGNALS\n";
  unity += "#include \"rtl_shim.h\"\n";
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const DatapathConfiguration& configuration = targets[i].configuration;
    const std::string prefix = variant_name(i);
    verilate(configuration, prefix, sources, folder, build);
    for (const fs::path& file : generated_files(folder, prefix)) {
      unity += fmt::format("#include \"{}\"\n", file.string());
    }
    unity += fmt::format("struct Parameters{} {{\n", i);
    for (const auto& [name, value] : rtl_parameters(configuration)) {
      unity += fmt::format("  static constexpr int {} = {};\n", name, value);
    }
    unity += "};\n";
    choice += fmt::format("  if (asked == \"{}\") return &kRtlInterface<{}, Parameters{}>;\n",
                          rtl_parameters_text(configuration), prefix, i);
  }
  unity += fmt::format(
      "#include <string_view>\n"
      "extern \"C\" __attribute__((visibility(\"default\"))) const RtlInterface* "
      "phongpipe_rtl_interface(const char* parameters) {{\n"
      "  const std::string_view asked = parameters;\n{}  return nullptr;\n}}\n",
      choice);
  write_text(folder / "unity.cpp", unity);
  const std::string built = "pixel_datapath.so";
  run_or_throw(
      {"g++", "-std=c++17", build == RtlBuild::fast ? "-O3" : "-O1", "-fPIC", "-shared",
       "-fvisibility=hidden", "-I" + include, "-I" + include + "/vltstd", "-I.",
       "-I" + installation().rtl_shim.string(), "-I" + installation().include.string(), "unity.cpp",
       (installation().libraries / "libphongpipe_verilated.a").string(), "-pthread", "-o", built},
      folder, sources);
  seal(folder / built);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    // A link of the same name may have been made by another process meanwhile.
    const fs::path link = folder / fmt::format("link{}", i);
    fs::create_hard_link(folder / built, link);
    fs::rename(link, targets[i].file);
  }
} catch (const fs::filesystem_error& error) {
  throw ToolError(fmt::format("{}: building the RTL failed: {}",
                              printable(targets.front().file.string()), error.code().message()));
}

}  // namespace phongpipe
