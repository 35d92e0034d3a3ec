// MTL: the material libraries of OBJ files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

// Ka, Kd, Ks and Ns; what is not given is as in the default material. `file` is what messages call
// it; notes tell which properties were left out that would change the picture. Throws InputError,
// which names the line.
std::vector<Material> read_mtl(const std::filesystem::path& file, std::string_view text,
                               std::vector<std::string>& notes);

}  // namespace phongpipe
