// The hardware of a run: formats, setup policy, pipeline and technology, from a preset, a file and
// --set.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "model/fixed/datapath_configuration.h"
#include "model/scene/scene.h"
#include "sim/pipeline_configuration.h"
#include "testbench/hardware/technology.h"

namespace phongpipe {

// All that a user chooses of the hardware.
struct Hardware {
  std::string name;  // of the preset or file
  FixedPointFormats formats;
  SetupPolicy setup;
  PipelineConfiguration pipeline;
  Technology technology;
};

// All settings, section by section, in the order of reports and hashes. The technology, which is a
// name, is not among them.
const Settings<Hardware>& hardware_settings();

// `name`: a preset or a file. `overrides`: key=value, with or without the section, or
// technology=card; keys that begin with kSceneSection are left to the scene. Throws InputError.
Hardware load_hardware(const std::string& name, const std::vector<std::string>& overrides);
// All settings and the technology from the text of a hardware file; `file` is what messages call
// it.
Hardware parse_hardware(const std::string& text, const std::filesystem::path& file);
Hardware override_hardware(Hardware hardware, const std::vector<std::string>& overrides);

// Keys of --set that change the scene: scene.light.0.color=…
constexpr std::string_view kSceneSection = "scene.";
inline bool is_scene_key(std::string_view key) {
  return key.substr(0, kSceneSection.size()) == kSceneSection;
}

// Replaces the settings left to the scene (number of channels, source of the gate) by those that
// the scene requires.
Hardware resolved(const Hardware& hardware, const EffectBlocks& blocks);

// Name of the shading method that evaluates the hardware's series in real arithmetic. Methods for a
// local viewer end in kLocalSuffix.
constexpr std::string_view kLocalSuffix = "-local";
std::string method_of(const Hardware& hardware, const Scene& scene);

// Identifies a result: a hash over every setting of resolved hardware and the technology, 16
// hexadecimal digits.
std::string configuration_hash(const Hardware& resolved_hardware);

}  // namespace phongpipe
