#include "testbench/system/installation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace fs = std::filesystem;

const Installation& installation() {
  static const Installation found = [] {
    const fs::path prefix = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
    const fs::path shared = prefix / "share" / "phongpipe";
    if (!fs::exists(shared / "hw")) {
      throw InputError(
          fmt::format("{}: no RTL here; keep bin/, lib/ and share/ together as "
                      "cmake --install lays them out",
                      shared.string()));
    }
    return Installation{shared / "hw", shared / "rtl", shared / "include", shared / "scenes",
                        prefix / "lib" / "phongpipe"};
  }();
  return found;
}

fs::path find_named(const std::string& name, const fs::path& folder, const std::string& what) {
  if (fs::exists(name)) return name;
  fs::path candidate = folder / (name + ".toml");
  if (fs::is_regular_file(candidate)) return candidate;
  std::vector<std::string> known;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") known.push_back(entry.path().stem().string());
  }
  std::sort(known.begin(), known.end());
  throw InputError(fmt::format("{}: no such file or {}; there are the {}s {}", name, what, what,
                               fmt::join(known, ", ")));
}

}  // namespace phongpipe
