// Random scenes for regressions: every effect, any light and material, and triangles that are hard
// to shade.
#pragma once

#include <cstdint>
#include <string_view>

#include "model/scene/scene.h"

namespace phongpipe {

// The name of a random scene is this and its seed.
constexpr std::string_view kRandomScene = "random:";

// The same scene for the same seed, on every machine: meshes in perspective or orthographic, or
// screen triangles from slivers to ones whose normals turn by 170°. Images have 16 to 96 pixels a
// side.
Scene random_scene(std::uint64_t seed);

}  // namespace phongpipe
