#include "testbench/rtl/rtl_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>

#include "model/files/text_file.h"
#include "model/scene/tool_error.h"
#include "testbench/rtl/rtl_cache.h"
#include "testbench/rtl/tool_folder.h"
#include "testbench/system/installation.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

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

// Returns what the tool prints. Complaints name the user's files.
std::string run_or_throw(const std::vector<std::string>& command, const ToolFolder& folder,
                         const std::vector<RtlSource>& sources) {
  const ProcessOutput output = folder.run(
      command, ", or choose a configuration that is built beforehand, such as a preset as it is");
  if (output.status == 0) return output.text;
  std::string complaint = first_complaint(output.text);
  for (const RtlSource& source : sources) {
    const std::size_t at = complaint.find(source.copy + ":");
    if (at == std::string::npos) continue;
    complaint.replace(at, source.copy.size(), source.original.string());
    break;
  }
  if (complaint.empty()) complaint = fmt::format("nothing, and ended with {}", output.status);
  throw ToolError(
      fmt::format("building the RTL failed: {} said: {}", command.front(), printable(complaint)));
}

std::string verilator_include(const ToolFolder& folder) {
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
              const std::vector<RtlSource>& sources, const ToolFolder& folder, RtlBuild build) {
  std::vector<std::string> command = {"verilator",
                                      "--cc",
                                      "-O3",
                                      "-Wall",
                                      "--Mdir",
                                      ".",
                                      "--prefix",
                                      prefix,
                                      "--top-module",
                                      std::string(traits(configuration.kind).rtl_module),
                                      "-I" + std::string(ToolFolder::kSources)};
  if (build == RtlBuild::signals) {
    command.insert(command.end(), {"--public-flat-rw", "--vpi"});
  }
  for (const auto& [name, value] : rtl_parameters(configuration)) {
    command.push_back(fmt::format("-G{}={}", name, value));
  }
  for (const RtlSource& source : sources) {
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

// The tools run in the scratch folder and get only names relative to it, or of the installation:
// Verilator is a Perl script that mangles others. All that it generates is compiled as one file,
// for most of the time of a file goes into headers.
void build_rtl(const std::vector<RtlTarget>& targets, const fs::path& sources_folder,
               RtlBuild build) try {
  const fs::path destination = fs::absolute(targets.front().file).parent_path();
  const ToolFolder tools(destination);
  const fs::path& folder = tools.path();
  const std::string include = verilator_include(tools);
  const std::vector<RtlSource> sources = tools.copy_sources(sources_folder);
  std::string unity, choice;
  if (build == RtlBuild::signals) unity += "#define PHONGPIPE_RTL_SIGNALS\n";
  unity += "#include \"rtl_shim.h\"\n";
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const DatapathConfiguration& configuration = targets[i].configuration;
    const std::string prefix = variant_name(i);
    verilate(configuration, prefix, sources, tools, build);
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
      tools, sources);
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
