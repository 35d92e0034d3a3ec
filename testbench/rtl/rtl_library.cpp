#include "testbench/rtl/rtl_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/system/installation.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// Names the configuration in file names and messages.
std::string parameters(const DatapathConfiguration& configuration) {
  std::string text;
  for (const auto& [name, value] : rtl_parameters(configuration)) {
    text += fmt::format("{}{}={}", text.empty() ? "" : "-", name, value);
  }
  return text;
}

std::vector<fs::path> rtl_sources(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".sv" || extension == ".svh") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The library's name carries a hash of what it is built from, so that a changed RTL is never
// answered with an old library.
std::string library_name(const DatapathConfiguration& configuration, const fs::path& sources) {
  std::string text;
  for (const fs::path& file : rtl_sources(sources)) text += read_whole_file(file);
  for (const char* file : {"rtl_abi.h", "rtl_shim.cpp"}) {
    text += read_whole_file(installation().rtl_shim / file);
  }
  return fmt::format("pixel_datapath-{}-{:016x}.so", parameters(configuration),
                     std::hash<std::string>{}(text));
}

fs::path user_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / "phongpipe";
  const char* home = std::getenv("HOME");
  return (home != nullptr && *home != '\0' ? fs::path(home) / ".cache"
                                           : fs::temp_directory_path()) /
         "phongpipe";
}

std::string verilator_include() {
  const char* const hint =
      "install the package `verilator`, or choose a configuration that is "
      "built beforehand, such as a preset as it is";
  const ProcessOutput output = run_process({"verilator", "--getenv", "VERILATOR_ROOT"});
  if (output.status != 0) {
    throw InputError(
        fmt::format("the RTL of this configuration must be built, and verilator is "
                    "not to be found; {}",
                    hint));
  }
  std::string root;
  for (LineReader lines(output.text); lines.rest() != "";) {  // the last line, after any warnings
    std::string_view line;
    if (lines.next(line) && !line.empty()) root = line;
  }
  return root + "/include";
}

// The line that says what is wrong, of all that a compiler prints.
std::string first_complaint(const std::string& text) {
  std::string first;
  std::string_view line;
  for (LineReader lines(text); lines.next(line);) {
    if (line.find("rror") != std::string_view::npos) return std::string(line);
    if (first.empty()) first = line;
  }
  return first;
}

void run_or_throw(const std::vector<std::string>& command) {
  const ProcessOutput output = run_process(command);
  if (output.status != 0) {
    throw InputError(fmt::format("building the RTL failed: {} said: {}", command.front(),
                                 first_complaint(output.text)));
  }
}

// A folder of our own that goes away with its contents.
class ScratchFolder {
 public:
  explicit ScratchFolder(const fs::path& beside) {
    fs::create_directories(beside);
    std::string name = (beside / "build-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw InputError(fmt::format("{}: cannot be written to", beside.string()));
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

void build(const DatapathConfiguration& c, const fs::path& sources, const fs::path& library) {
  const std::string include = verilator_include();
  const ScratchFolder scratch(library.parent_path());
  const std::string folder = scratch.path().string();
  std::vector<std::string> verilate = {"verilator",
                                       "--cc",
                                       "-O3",
                                       "-Wall",
                                       "--Mdir",
                                       folder,
                                       "--prefix",
                                       "Vpixel_datapath",
                                       "--top-module",
                                       "pixel_datapath",
                                       "-I" + sources.string()};
  for (const auto& [name, value] : rtl_parameters(c)) {
    verilate.push_back(fmt::format("-G{}={}", name, value));
  }
  for (const fs::path& file : rtl_sources(sources)) {
    if (file.extension() == ".sv") verilate.push_back(file.string());
  }
  run_or_throw(verilate);

  std::vector<std::string> compile = {"g++",
                                      "-std=c++17",
                                      "-O3",
                                      "-fPIC",
                                      "-shared",
                                      "-fvisibility=hidden",
                                      "-I" + include,
                                      "-I" + include + "/vltstd",
                                      "-I" + folder,
                                      "-I" + installation().rtl_shim.string(),
                                      "-I" + installation().include.string(),
                                      (installation().rtl_shim / "rtl_shim.cpp").string()};
  for (const auto& [name, value] : rtl_parameters(c)) {
    compile.push_back(fmt::format("-DPHONGPIPE_{}={}", name, value));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".cpp") compile.push_back(entry.path().string());
  }
  const fs::path built = scratch.path() / library.filename();
  compile.push_back((installation().libraries / "libphongpipe_verilated.a").string());
  compile.insert(compile.end(), {"-pthread", "-o", built.string()});
  run_or_throw(compile);
  fs::rename(built, library);  // whole or not at all, also where two build at once
}

}  // namespace

RtlLibrary::RtlLibrary(const DatapathConfiguration& configuration, const RtlBuildOptions& options) {
  configuration.check();
  const fs::path sources = options.sources.empty() ? installation().hardware : options.sources;
  const std::string name = library_name(configuration, sources);
  const fs::path kept = options.destination.empty() ? user_cache() : options.destination;
  file_ = installation().libraries / "rtl" / name;
  if (!fs::exists(file_)) file_ = kept / name;
  if (!fs::exists(file_)) {
    if (options.progress) options.progress(parameters(configuration));
    build(configuration, sources, file_);
  }
  handle_ = dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    throw InputError(fmt::format("{}; remove the file to have it built anew", dlerror()));
  }
  const auto get =
      reinterpret_cast<const RtlInterface* (*)()>(dlsym(handle_, "phongpipe_rtl_interface"));
  if (get == nullptr) throw InputError(fmt::format("{}: {}", file_.string(), dlerror()));
  interface_ = get();
}

RtlLibrary::~RtlLibrary() {
  dlclose(handle_);
}

}  // namespace phongpipe
