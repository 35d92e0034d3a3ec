#include "testbench/cases/named_scene.h"

#include <fmt/format.h>

#include "model/files/scene_file.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/cases/random_scene.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/installation.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

Scene scene_of_seed(const std::string& name, const std::vector<std::string>& overrides) {
  const auto seed = parse_integer(name.substr(kRandomScene.size()));
  if (!seed || *seed < 0) {
    throw InputError(fmt::format("{}: a random scene has a seed, a whole number of at least 0",
                                 printable(name)));
  }
  if (!overrides.empty()) {
    throw InputError(fmt::format("scene.{}: a random scene has no file whose keys could change",
                                 overrides.front()));
  }
  return random_scene(static_cast<std::uint64_t>(*seed));
}

}  // namespace

Scene load_named_scene(const std::string& name, const std::vector<std::string>& settings) {
  std::vector<std::string> overrides;
  for (const std::string& setting : settings) {
    if (is_scene_key(setting)) {
      overrides.push_back(setting.substr(kSceneSection.size()));
    }
  }
  Scene scene = starts_with(name, kRandomScene)
                    ? scene_of_seed(name, overrides)
                    : load_scene(find_named(name, installation().scenes, "scene"), overrides);
  scene.source = printable(name);
  return scene;
}

}  // namespace phongpipe
