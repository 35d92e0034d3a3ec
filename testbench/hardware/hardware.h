// The hardware of a run: datapath, pipeline and technology, from a preset, a file and --set.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/fixed/frame_setup.h"
#include "sim/pipeline_configuration.h"
#include "testbench/hardware/technology.h"

namespace phongpipe {

struct Hardware {
  std::string name;  // of the preset or file
  DatapathConfiguration datapath;
  bool choose_channels = true;  // one for grey scenes, else three
  PipelineConfiguration pipeline;
  Technology technology;

  double clock_ns() const { return technology.clock_ns(datapath); }
};

// One knob, under the name it has in files, in --set and in reports.
struct Setting {
  std::string_view section, key;
  std::vector<std::string_view> choices;  // empty: a whole number
  std::function<int()> get;               // the number, or the choice's index
  std::function<void(int)> put;

  std::string name() const;
  std::string value() const;
};

// All knobs of `hardware`, which must outlive them.
std::vector<Setting> settings(Hardware& hardware);

// `name`: a preset or a file. `overrides`: key=value, with or without the section, or
// technology=card. Throws InputError.
Hardware load_hardware(const std::string& name, const std::vector<std::string>& overrides);

// Sets what the scene decides: channels, the blocks of its effects, the source of the gate.
void suit_scene(Hardware& hardware, const Scene& scene, const Geometry& geometry,
                Effects effects = Effects::derived);

// The method that is the hardware's series in real arithmetic; those for a local viewer end alike.
constexpr std::string_view kLocalSuffix = "-local";
std::string method_of(const Hardware& hardware, const Scene& scene);

// Identifies a result: a hash over every setting and the technology, 16 hexadecimal digits.
std::string configuration_hash(const Hardware& hardware);

}  // namespace phongpipe
