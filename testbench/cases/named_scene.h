// Scenes by name: files, shipped scenes, and random scenes.
#pragma once

#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

// `name`: a file; a shipped scene; or random:SEED, see random_scene(). Messages refer to the scene
// by `name`. Of `settings`, key=value as for --set, those that begin with `scene.` change keys of
// the file: scene.material.gold.shininess=20. Throws InputError.
Scene load_named_scene(const std::string& name, const std::vector<std::string>& settings = {});

}  // namespace phongpipe
