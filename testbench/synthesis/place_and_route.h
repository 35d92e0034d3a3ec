// Places and routes RTL on an iCE40 device with yosys and nextpnr-ice40, between
// registers, so that pins do not limit.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "model/fixed/datapath_configuration.h"
#include "testbench/hardware/technology.h"
#include "testbench/rtl/tool_folder.h"

namespace phongpipe {

constexpr int kPlacementSeeds = 7;

// A module to synthesise. It has a port `clk` besides those named.
struct SynthesisTarget {
  struct Port {
    std::string name;
    int width = 1;
  };
  std::string module;
  RtlParameters parameters;
  std::vector<Port> inputs, outputs;
  // Blocks by a part of the names that their cells have in the flattened netlist.
  std::vector<std::pair<std::string, std::string>> blocks;
  // Of the design in a card, MeasuredDesign::parameters; empty: as parameters_text() has them.
  std::string name = {};
};
SynthesisTarget datapath_target(const DatapathConfiguration& configuration);

// A module, synthesised for all iCE40 devices; its files are deleted with it.
class Netlist {
 public:
  // `sources`: a folder of RTL. Throws ToolError with the first error of a tool, or with what to
  // install.
  Netlist(const SynthesisTarget& target, const std::filesystem::path& sources);

  // With `seeds` seeds, two at a time. Throws ToolError, or InputError if the design is too large
  // for the device.
  MeasuredDesign place(const std::string& device, const std::string& package,
                       int seeds = kPlacementSeeds) const;

 private:
  ToolFolder tools_;
  std::vector<std::pair<std::string, std::string>> blocks_;
  MeasuredDesign area_;
};

// "yosys 0.23 and nextpnr-ice40 0.4".
std::string synthesis_tools();

}  // namespace phongpipe
