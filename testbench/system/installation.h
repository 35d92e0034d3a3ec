// Where the program finds its RTL, presets, technology cards and scenes: beside itself, both in the
// build tree and in an installed prefix.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phongpipe {

struct Installation {
  std::filesystem::path hardware;  // RTL, presets/, technology/
  std::filesystem::path rtl_shim;  // sources compiled with the Verilated RTL
  std::filesystem::path include;   // the headers of model/ that they include
  std::filesystem::path scenes, sweeps, hard_cases;
  std::filesystem::path page;       // form, style and scripts of pages of results
  std::filesystem::path libraries;  // Verilator's runtime, and RTL that was built beforehand
};

// Throws InputError if the program has been moved away from its files.
const Installation& installation();

// The names of the .toml files in a folder and its subfolders, as find_named() takes them; sorted.
std::vector<std::string> names_in(const std::filesystem::path& folder);

// The file `name` if it exists and is not a folder, else folder/name.toml. If neither exists,
// throws InputError that lists the contents of the folder and its subfolders. `what`: "preset",
// "technology card", …, for messages.
std::filesystem::path find_named(const std::string& name, const std::filesystem::path& folder,
                                 const std::string& what);

}  // namespace phongpipe
