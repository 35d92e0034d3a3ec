#include "testbench/rtl/rtl_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
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

// Names the configuration in file names and messages.
std::string parameters(const DatapathConfiguration& configuration) {
  std::string text;
  for (const auto& [name, value] : rtl_parameters(configuration)) {
    text += fmt::format("{}{}={}", text.empty() ? "" : "-", name, value);
  }
  return text;
}

// The library's name carries a hash of what it is built from, so that a changed RTL is never
// answered with an old library.
std::string library_name(const DatapathConfiguration& configuration, const fs::path& sources) {
  std::vector<fs::path> files = rtl_sources(sources);
  for (const char* file : {"rtl_abi.h", "rtl_shim.cpp"}) {
    files.push_back(installation().rtl_shim / file);
  }
  FnvHash hash;
  for (const fs::path& file : files) {
    const std::string text = read_whole_file(file);
    hash.add(file.filename().string());
    hash.add(text.size());
    hash.add(text);
  }
  return fmt::format("pixel_datapath-{}-{:016x}.so", parameters(configuration), hash.value());
}

fs::path user_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / "phongpipe";
  const char* home = std::getenv("HOME");
  return (home != nullptr && *home != '\0' ? fs::path(home) / ".cache"
                                           : fs::temp_directory_path()) /
         "phongpipe";
}

}  // namespace

RtlLibrary::RtlLibrary(const DatapathConfiguration& configuration, const RtlBuildOptions& options) {
  configuration.check();
  const fs::path sources = options.sources.empty() ? installation().hardware : options.sources;
  const std::string name = library_name(configuration, sources);
  const fs::path kept = options.destination.empty() ? user_cache() : options.destination;
  std::error_code none;
  file_ = installation().libraries / "rtl" / name;
  if (!fs::exists(file_, none)) file_ = kept / name;
  if (!fs::exists(file_, none)) {
    if (options.progress) options.progress(parameters(configuration));
    build_rtl(configuration, sources, file_);
  }
  handle_ = dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    throw ToolError(fmt::format("{}; remove the file to have it built anew", printable(dlerror())));
  }
  const auto get =
      reinterpret_cast<const RtlInterface* (*)()>(dlsym(handle_, "phongpipe_rtl_interface"));
  if (get == nullptr) {
    throw ToolError(fmt::format("{}: {}", printable(file_.string()), dlerror()));
  }
  interface_ = get();
}

RtlLibrary::~RtlLibrary() {
  dlclose(handle_);
}

}  // namespace phongpipe
