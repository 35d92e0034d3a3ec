// Loads the scenes and the hardware of a campaign, each once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "model/fixed/prepared_frame.h"
#include "testbench/cosim/run.h"

namespace phongpipe {

struct LoadedScene {
  Scene scene;
  std::uint64_t hash = 0;
  std::size_t order = 0;                                // in which scenes were loaded
  mutable std::weak_ptr<const PreparedScene> prepared;  // as long as someone uses it
};

class Loader {
 public:
  // The scene of a run, which depends on its name and on those of its settings that begin with
  // `scene.`. Throws InputError.
  const LoadedScene& scene(const RunRequest& request);

  // Whether scene, preset and technology are there, as far as the request names them without
  // changes of the scene. Throws InputError for a name that nothing has: a mistake of the whole
  // campaign.
  void check_names(const RunRequest& request);

  // Throws InputError.
  Hardware hardware(const RunRequest& request);

  // The last one is kept for the next call. Throws InputError.
  std::shared_ptr<const PreparedScene> prepared(const LoadedScene& scene);

 private:
  const Hardware& preset(const std::string& name);

  std::map<std::string, LoadedScene> scenes_;
  std::set<std::string> cards_;
  std::map<std::string, Hardware> presets_;
  std::shared_ptr<const PreparedScene> last_;
};

}  // namespace phongpipe
