// Where the program finds its RTL, presets, technology cards and scenes: beside itself, in the
// build tree as in an installed prefix.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phongpipe {

struct Installation {
  std::filesystem::path hardware;  // RTL, presets/, technology/
  std::filesystem::path rtl_shim;  // sources compiled with the Verilated RTL
  std::filesystem::path include;   // what they include of model/
  std::filesystem::path scenes;
  std::filesystem::path libraries;  // Verilator's runtime, and RTL that was built beforehand
};

// Throws InputError where the program has been moved away from its files.
const Installation& installation();

// `name` as a file if there is one that is not a folder, else folder/name.toml. Throws InputError
// that lists what the folder and its subfolders hold. `what` is "preset", "technology card", ….
std::filesystem::path find_named(const std::string& name, const std::filesystem::path& folder,
                                 const std::string& what);

}  // namespace phongpipe
