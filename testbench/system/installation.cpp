#include "testbench/system/installation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "model/files/spelling.h"
#include "model/scene/input_error.h"
#include "testbench/system/terminal.h"

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
    return Installation{
        shared / "hw",     shared / "rtl",        shared / "include", shared / "scenes",
        shared / "sweeps", shared / "hard_cases", shared / "page",    prefix / "lib" / "phongpipe"};
  }();
  return found;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    names.push_back(entry.path().lexically_relative(folder).replace_extension().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

namespace {

// "pawn, torus, effects/{ambient, nettle}"
std::string listed(const std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::string>> groups;  // by subfolder
  for (const std::string& name : names) {
    const fs::path path = name;
    groups[path.parent_path().string()].push_back(path.filename().string());
  }
  std::vector<std::string> texts;
  for (const auto& [folder, members] : groups) {
    const std::string text = fmt::format("{}", fmt::join(members, ", "));
    texts.push_back(folder.empty() ? text : fmt::format("{}/{{{}}}", folder, text));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// The name that `word` is a likely misspelling of, with or without its subfolder; or an empty text.
std::string likely_name(const std::string& word, const std::vector<std::string>& names) {
  std::string whole = closest_word(word, names);
  if (!whole.empty()) return whole;
  std::vector<std::string> last_parts;
  last_parts.reserve(names.size());
  for (const std::string& name : names) last_parts.push_back(fs::path(name).filename().string());
  const std::string last = closest_word(word, last_parts);
  const auto found = std::find(last_parts.begin(), last_parts.end(), last);
  return found == last_parts.end() ? ""
                                   : names[static_cast<std::size_t>(found - last_parts.begin())];
}

}  // namespace

fs::path find_named(const std::string& name, const fs::path& folder, const std::string& what) {
  std::error_code none;
  const bool is_folder = fs::is_directory(name, none);
  if (!is_folder && fs::exists(name, none)) return name;
  fs::path candidate = folder / (name + ".toml");
  if (fs::is_regular_file(candidate, none)) return candidate;
  const std::vector<std::string> known = names_in(folder);
  const std::string likely = likely_name(name, known);
  throw InputError(fmt::format("{}: {}; {}there are the {}s {}", printable(name),
                               is_folder ? fmt::format("is a folder, not a {}", what)
                                         : fmt::format("no such file or {}", what),
                               likely.empty() ? "" : fmt::format("did you mean {}? ", likely), what,
                               listed(known)));
}

}  // namespace phongpipe
