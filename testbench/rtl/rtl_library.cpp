#include "testbench/rtl/rtl_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <set>
#include <vector>

#include "model/files/text_file.h"
#include "testbench/rtl/rtl_builder.h"
#include "testbench/system/fnv_hash.h"
#include "testbench/system/installation.h"
#include "testbench/system/terminal.h"
#include "testbench/system/tool_error.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

fs::path user_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / "phongpipe";
  const char* home = std::getenv("HOME");
  return (home != nullptr && *home != '\0' ? fs::path(home) / ".cache"
                                           : fs::temp_directory_path()) /
         "phongpipe";
}

// Where the libraries of one folder of sources are. Their names carry a hash of what they are built
// from, so that a changed RTL is never answered with an old library.
class LibraryFiles {
 public:
  explicit LibraryFiles(const RtlBuildOptions& options)
      : sources_(options.sources.empty() ? installation().hardware : options.sources),
        kept_(options.destination.empty() ? user_cache() : options.destination),
        signals_(options.build == RtlBuild::signals ? "signals-" : ""),
        hash_(rtl_hash(sources_)) {}

  const fs::path& sources() const { return sources_; }
  // The file, which need not exist.
  fs::path file_of(const DatapathConfiguration& configuration) const {
    const std::string name = fmt::format("pixel_datapath-{}{}-{:016x}.so", signals_,
                                         rtl_parameters_text(configuration), hash_);
    fs::path installed = installation().libraries / "rtl" / name;
    std::error_code none;
    return fs::exists(installed, none) ? installed : kept_ / name;
  }

 private:
  fs::path sources_, kept_;
  const char* signals_;
  std::uint64_t hash_;
};

}  // namespace

std::uint64_t rtl_hash(const fs::path& folder) {
  const fs::path& sources = folder.empty() ? installation().hardware : folder;
  std::vector<fs::path> files = rtl_sources(sources);
  for (const char* file : {"rtl_abi.h", "rtl_shim.h"}) {
    files.push_back(installation().rtl_shim / file);
  }
  FnvHash hash;
  for (const fs::path& file : files) {
    const std::string text = read_whole_file(file);
    hash.add(file.filename().string());
    hash.add(text.size());
    hash.add(text);
  }
  return hash.value();
}

void build_missing_rtl(const std::vector<DatapathConfiguration>& configurations,
                       const RtlBuildOptions& options) {
  const LibraryFiles files(options);
  std::vector<RtlTarget> missing;
  std::set<fs::path> seen;
  for (const DatapathConfiguration& configuration : configurations) {
    configuration.check();
    fs::path file = files.file_of(configuration);
    std::error_code none;
    if (fs::exists(file, none) || !seen.insert(file).second) continue;
    missing.push_back({configuration, std::move(file)});
  }
  if (missing.empty()) return;
  if (options.progress) {
    options.progress(missing.size() == 1 ? rtl_parameters_text(missing.front().configuration)
                                         : fmt::format("{} configurations", missing.size()));
  }
  build_rtl(missing, files.sources(), options.build);
}

RtlLibrary::RtlLibrary(const DatapathConfiguration& configuration, const RtlBuildOptions& options) {
  build_missing_rtl({configuration}, options);
  file_ = LibraryFiles(options).file_of(configuration);
  handle_ = dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    throw ToolError(fmt::format("{}; remove the file to have it built anew", printable(dlerror())));
  }
  const auto get = reinterpret_cast<decltype(&phongpipe_rtl_interface)>(
      dlsym(handle_, "phongpipe_rtl_interface"));
  if (get == nullptr) {
    throw ToolError(fmt::format("{}: {}", printable(file_.string()), dlerror()));
  }
  interface_ = get(rtl_parameters_text(configuration).c_str());
  if (interface_ == nullptr) {
    throw ToolError(
        fmt::format("{}: not the RTL that its name says; remove the file to have it "
                    "built anew",
                    printable(file_.string())));
  }
}

RtlLibrary::~RtlLibrary() {
  dlclose(handle_);
}

}  // namespace phongpipe
