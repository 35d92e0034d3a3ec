// A scene from its TOML file, with the meshes and triangles that the file names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

// Parses and checks everything; throws InputError. Unknown and missing keys, wrong types, values
// out of range and NaN are errors that name file and line. `overrides`: path=value, see
// TomlTable::read_file.
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

// The same of a text; `source` is what messages call it. Files that it names are looked for beside
// `source`.
Scene parse_scene(const std::string& text, const std::filesystem::path& source);

}  // namespace phongpipe
