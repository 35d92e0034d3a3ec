#include "testbench/campaign/loader.h"

#include "testbench/cases/named_scene.h"
#include "testbench/cosim/scene_hash.h"

namespace phongpipe {

const LoadedScene& Loader::scene(const RunRequest& request) {
  std::string key = request.scene;
  for (const std::string& setting : request.settings) {
    if (is_scene_key(setting)) key += "\n" + setting;
  }
  const auto found = scenes_.find(key);
  if (found != scenes_.end()) return found->second;
  LoadedScene loaded;
  loaded.scene = load_named_scene(request.scene, request.settings);
  loaded.hash = scene_hash(loaded.scene);
  loaded.order = scenes_.size();
  return scenes_.emplace(key, std::move(loaded)).first->second;
}

void Loader::check_names(const RunRequest& request) {
  bool changed = false;
  for (const std::string& setting : request.settings) {
    constexpr std::string_view kCard = "technology=";
    if (setting.compare(0, kCard.size(), kCard) == 0 && cards_.insert(setting).second) {
      load_technology(setting.substr(kCard.size()));
    }
    changed = changed || is_scene_key(setting);
  }
  if (!changed) scene(request);
  preset(request.hardware);
}

Hardware Loader::hardware(const RunRequest& request) {
  return override_hardware(preset(request.hardware), request.settings);
}

std::shared_ptr<const PreparedScene> Loader::prepared(const LoadedScene& scene) {
  last_ = scene.prepared.lock();
  if (!last_) {
    last_ = std::make_shared<const PreparedScene>(scene.scene, true);
    scene.prepared = last_;
  }
  return last_;
}

const Hardware& Loader::preset(const std::string& name) {
  auto found = presets_.find(name);
  if (found == presets_.end()) found = presets_.emplace(name, load_hardware(name, {})).first;
  return found->second;
}

}  // namespace phongpipe
