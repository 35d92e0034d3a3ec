// The [[object]] tables of a scene file.
#pragma once

#include <vector>

#include "model/files/toml_reader.h"
#include "model/scene/scene.h"

namespace phongpipe {

// Checks the tables, also that each material is one of `materials`, and reads the files that they
// name.
std::vector<Object> read_objects(const TomlTable& root, const std::vector<Material>& materials,
                                 const Image& image);

}  // namespace phongpipe
