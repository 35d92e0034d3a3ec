// A scene as one TOML text, which needs no other file.
#pragma once

#include <string>

#include "model/scene/scene.h"

namespace phongpipe {

// Meshes and screen-space triangles are written vertex by vertex. Reading the text gives the same
// scene, bit by bit, but for its name and for the notes about its files.
std::string scene_toml(const Scene& scene);

}  // namespace phongpipe
