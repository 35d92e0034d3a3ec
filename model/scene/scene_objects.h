// The [[object]] tables of a scene file.
#pragma once

#include <vector>

#include "model/scene/scene.h"
#include "model/scene/toml_reader.h"

namespace phongpipe {

// Checks them, also that the files they name exist and that their material is one of `materials`.
std::vector<Object> read_objects(const TomlTable& root, const std::vector<Material>& materials);

}  // namespace phongpipe
