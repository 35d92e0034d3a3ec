// Hash of all that a scene contains, meshes included, whatever file it came from.
#pragma once

#include <cstdint>

#include "model/scene/scene.h"

namespace phongpipe {

std::uint64_t scene_hash(const Scene& scene);

}  // namespace phongpipe
