// Places and routes pixel_datapath on an iCE40 device with yosys and nextpnr-ice40, between
// registers, so that pins do not limit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/fixed/datapath_configuration.h"
#include "testbench/hardware/technology.h"

namespace phongpipe {

constexpr int kPlacementSeeds = 3;

// A configuration, synthesised for all iCE40 devices; its files are deleted with it.
class Netlist {
 public:
  // `sources`: a folder of RTL. Throws ToolError with the first error of a tool, or with what to
  // install.
  Netlist(const DatapathConfiguration& configuration, const std::filesystem::path& sources);
  ~Netlist();
  Netlist(const Netlist&) = delete;
  Netlist& operator=(const Netlist&) = delete;

  // With `seeds` seeds, two at a time. Throws ToolError, or InputError if the design is too large
  // for the device.
  MeasuredDesign place(const std::string& device, const std::string& package,
                       int seeds = kPlacementSeeds) const;

 private:
  MeasuredDesign area_;
  std::filesystem::path folder_;
};

// "yosys 0.23 and nextpnr-ice40 0.4".
std::string synthesis_tools();

}  // namespace phongpipe
