#include "testbench/rtl/rtl_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstring>
#include <set>
#include <vector>

#include "model/files/text_file.h"
#include "model/scene/tool_error.h"
#include "testbench/rtl/rtl_builder.h"
#include "testbench/rtl/rtl_cache.h"
#include "testbench/rtl/tool_folder.h"
#include "testbench/system/installation.h"
#include "testbench/system/sha256.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// Where the libraries of one folder of sources are. Their names carry a hash of what they are built
// from, so that a changed RTL is never answered with an old library.
class LibraryFiles {
 public:
  explicit LibraryFiles(const RtlBuildOptions& options)
      : sources_(options.sources.empty() ? installation().hardware : options.sources),
        destination_(options.destination),
        signals_(options.build == RtlBuild::signals ? "signals-" : ""),
        hash_(rtl_hash(sources_)) {}

  const fs::path& sources() const { return sources_; }
  // A library that is whole, or the place where it is to be built.
  fs::path file_of(const DatapathConfiguration& configuration) const {
    const std::string name = fmt::format("pixel_datapath-{}{}-{:016x}.so", signals_,
                                         rtl_parameters_text(configuration), hash_);
    fs::path installed = installation().libraries / "rtl" / name;
    return is_sealed(installed) ? installed : kept() / name;
  }
  // The folder of libraries that are built now.
  fs::path kept() const { return destination_.empty() ? user_cache() : destination_; }

 private:
  fs::path sources_, destination_;
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
  std::string contents;
  for (const fs::path& file : files) {
    const std::string text = read_whole_file(file);
    contents += fmt::format("{}\n{}\n", file.filename().string(), text.size()) + text;
  }
  const Sha256 digest = sha256(contents);
  std::uint64_t hash = 0;
  std::memcpy(&hash, digest.data(), sizeof hash);
  return hash;
}

namespace {

// Those that are not built, each once.
std::vector<RtlTarget> missing_of(const std::vector<DatapathConfiguration>& configurations,
                                  const LibraryFiles& files) {
  std::vector<RtlTarget> missing;
  std::set<fs::path> seen;
  for (const DatapathConfiguration& configuration : configurations) {
    configuration.check();
    fs::path file = files.file_of(configuration);
    if (!seen.insert(file).second || is_sealed(file)) continue;
    missing.push_back({configuration, std::move(file)});
  }
  return missing;
}

void build_missing(const std::vector<DatapathConfiguration>& configurations,
                   const LibraryFiles& files, const RtlBuildOptions& options) {
  std::vector<RtlTarget> missing = missing_of(configurations, files);
  if (missing.empty()) return;
  std::vector<fs::path> targets;
  targets.reserve(missing.size());
  for (const RtlTarget& target : missing) targets.push_back(target.file);
  const auto tell = [&](const char* more) {
    if (!options.progress) return;
    options.progress((missing.size() == 1 ? rtl_parameters_text(missing.front().configuration)
                                          : fmt::format("{} configurations", missing.size())) +
                     more);
  };
  const BuildLock lock(files.kept(), targets,
                       [&] { tell(", which another phongpipe builds: waiting for it"); });
  missing = missing_of(configurations, files);
  if (missing.empty()) return;
  tell("");
  build_rtl(missing, files.sources(), options.build);
}

}  // namespace

void build_missing_rtl(const std::vector<DatapathConfiguration>& configurations,
                       const RtlBuildOptions& options) {
  build_missing(configurations, LibraryFiles(options), options);
}

RtlLibrary::RtlLibrary(const DatapathConfiguration& configuration, const RtlBuildOptions& options) {
  load(configuration, options);
  if (interface_ != nullptr) return;
  // Another library under this name, which somebody has copied there.
  dlclose(handle_);
  std::error_code ignored;
  fs::remove(file_, ignored);
  load(configuration, options);
  if (interface_ == nullptr) {
    throw ToolError(
        fmt::format("{}: not the RTL that its name says; remove the file to have it "
                    "built anew",
                    printable(file_.string())));
  }
}

void RtlLibrary::load(const DatapathConfiguration& configuration, const RtlBuildOptions& options) {
  const LibraryFiles files(options);
  build_missing({configuration}, files, options);
  file_ = files.file_of(configuration);
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
}

RtlLibrary::~RtlLibrary() {
  dlclose(handle_);
}

}  // namespace phongpipe
