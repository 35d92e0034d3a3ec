#include "testbench/synthesis/place_and_route.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <future>
#include <nlohmann/json.hpp>
#include <regex>

#include "model/files/text_file.h"
#include "model/fixed/constants.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/rtl/rtl_builder.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

struct Port {
  const char* name;
  int width;
};

std::vector<Port> inputs_of(const DatapathConfiguration& c) {
  const int diffuse = c.diffuse_width(), specular = c.specular_width(), channels = c.channels;
  return {{"reset", 1},
          {"span_valid", 1},
          {"span_x", kCoordinateBits},
          {"span_y", kCoordinateBits},
          {"span_length", kLengthBits},
          {"span_first_pass", 1},
          {"span_step_diffuse", 1},
          {"span_step_specular", 1},
          {"span_highlight", 1},
          {"span_diffuse_v", channels * diffuse},
          {"span_diffuse_d1", channels * diffuse},
          {"span_diffuse_d2", channels * diffuse},
          {"span_level", channels * diffuse},
          {"span_specular_v", specular},
          {"span_specular_d1", specular},
          {"span_specular_d2", specular},
          {"span_gate_v", diffuse},
          {"span_gate_d1", diffuse},
          {"span_gate_d2", diffuse},
          {"span_cue_v", kCueWidth},
          {"span_cue_d1", kCueWidth},
          {"cue_color", channels * kOutputBits},
          {"rom_write", 1},
          {"rom_address", c.rom_address_bits},
          {"rom_data", channels * c.rom_data_bits},
          {"pixel_ready", 1}};
}

std::vector<Port> outputs_of(const DatapathConfiguration& c) {
  return {{"span_ready", 1},
          {"pixel_valid", 1},
          {"pixel_x", kCoordinateBits},
          {"pixel_y", kCoordinateBits},
          {"pixel_color", c.channels * kOutputBits}};
}

// All ports between registers: a chain that fills the inputs from a pin, and one that empties the
// outputs to a pin.
std::string harness(const DatapathConfiguration& c) {
  int inputs = 0, outputs = 0;
  std::string connections;
  for (const Port& port : inputs_of(c)) {
    connections += fmt::format(", .{}(in[{}+:{}])", port.name, inputs, port.width);
    inputs += port.width;
  }
  for (const Port& port : outputs_of(c)) {
    connections += fmt::format(", .{}(out[{}+:{}])", port.name, outputs, port.width);
    outputs += port.width;
  }
  std::vector<std::string> parameters;
  for (const auto& [name, value] : rtl_parameters(c)) {
    parameters.push_back(fmt::format(".{}({})", name, value));
  }
  return fmt::format(
      "module harness(input clk, input fill, input take, output empty);\n"
      "  reg [{0}:0] in;\n  reg [{1}:0] taken;\n  reg taking;\n  wire [{1}:0] out;\n"
      "  assign empty = taken[0];\n"
      "  always @(posedge clk) begin\n"
      "    in <= {{in, fill}};\n    taking <= take;\n    taken <= taking ? out : taken >> 1;\n"
      "  end\n  pixel_datapath #({2}) dut (.clk(clk){3});\nendmodule\n",
      inputs - 1, outputs - 1, fmt::join(parameters, ", "), connections);
}

// Throws ToolError if it fails, InputError if the design is too large for the device.
void run_tool(const std::vector<std::string>& command, const fs::path& folder) {
  const ProcessOutput output = run_process(command, folder);
  if (output.status == 0) return;
  if (output.start_error != 0) {
    throw ToolError(fmt::format("{} could not be started; install it: apt install {} (Debian)",
                                command.front(), command.front()));
  }
  std::smatch line;
  static const std::regex error("ERROR: ([^\n]*)");
  std::string message = "it failed without a message";
  if (std::regex_search(output.text, line, error)) message = line[1];
  if (message.find("no BELs remaining") != std::string::npos) {
    throw InputError(
        fmt::format("the design is too large for the device: reduce widths, tables or channels, or "
                    "choose another card; {} said: {}",
                    command.front(), message));
  }
  throw ToolError(fmt::format("{} said: {}", command.front(), message));
}

// The block of hw/ that a cell of the flattened netlist belongs to, by its name.
std::string block_of(const std::string& cell) {
  constexpr std::pair<const char*, const char*> kBlocks[] = {{"_series.", "forward_differencer"},
                                                             {".rom.", "exponent_rom"},
                                                             {".summation.", "color_sum"},
                                                             {".multiplier.", "depth_cue"},
                                                             {".queue.", "pixel_queue"}};
  for (const auto& [part, block] : kBlocks) {
    if (cell.find(part) != std::string::npos) return block;
  }
  return "control";
}

struct Placement {
  double clock_ns = 0;
  std::string limited_by;
};

Placement read_report(const fs::path& file) {
  const auto report = nlohmann::json::parse(read_whole_file(file));
  Placement placement;
  for (const auto& clock : report.at("fmax")) {
    constexpr double kNsTimesMhz = 1000;
    placement.clock_ns = kNsTimesMhz / clock.at("achieved").get<double>();
  }
  for (const auto& path : report.at("critical_paths")) {
    const auto is_clocked = [&path](const char* end) {
      return path.at(end).get<std::string>().rfind("posedge", 0) == 0;
    };
    if (!is_clocked("from") || !is_clocked("to")) continue;
    placement.limited_by = block_of(path.at("path").back().at("to").at("cell"));
  }
  if (placement.clock_ns <= 0) throw ToolError("nextpnr-ice40 reported no clock");
  return placement;
}

}  // namespace

Netlist::Netlist(const DatapathConfiguration& configuration, const fs::path& sources) {
  std::string name = (fs::temp_directory_path() / "phongpipe-synthesis-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw ToolError(fmt::format("{}: {}", name, std::strerror(errno)));
  }
  folder_ = name;
  std::string files;
  int modules = 0;
  for (const fs::path& source : rtl_sources(sources)) {
    // What is included keeps its name; a module gets one that yosys's script cannot misread.
    const bool is_module = source.extension() == ".sv";
    const std::string copy =
        is_module ? fmt::format("{}.sv", modules++) : source.filename().string();
    fs::copy_file(source, folder_ / copy);
    if (is_module) files += " " + copy;
  }
  write_text(folder_ / "harness.v", harness(configuration));
  std::string sets;
  for (const auto& [parameter, value] : rtl_parameters(configuration)) {
    sets += fmt::format(" -set {} {}", parameter, value);
  }
  // Once alone, for its area, and once between registers.
  run_tool({"yosys", "-q", "-p",
            fmt::format("read_verilog -sv -I.{0}; chparam{1} pixel_datapath; synth_ice40 -top "
                        "pixel_datapath; tee -q -o area.json stat -json; design -reset; "
                        "read_verilog -sv -I.{0} harness.v; synth_ice40 -top harness -json "
                        "harness.json",
                        files, sets)},
           folder_);
  const auto area = nlohmann::json::parse(read_whole_file(folder_ / "area.json"));
  area_.parameters = rtl_parameters_text(configuration);
  for (const auto& [cell, count] : area.at("design").at("num_cells_by_type").items()) {
    if (cell == "SB_LUT4") area_.luts += count.get<int>();
    if (cell == "SB_CARRY") area_.carries += count.get<int>();
    if (cell.rfind("SB_DFF", 0) == 0) area_.registers += count.get<int>();
    if (cell.rfind("SB_RAM40", 0) == 0) area_.block_rams += count.get<int>();
  }
}

Netlist::~Netlist() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

MeasuredDesign Netlist::place(const std::string& device, const std::string& package,
                              int seeds) const {
  const auto place_once = [&](int seed) {
    const std::string report = fmt::format("{}-{}.json", device, seed);
    run_tool({"nextpnr-ice40", "-q", "--" + device, "--package", package, "--json", "harness.json",
              "--seed", std::to_string(seed), "--freq", "200", "--timing-allow-fail",
              "--pcf-allow-unconstrained", "--report", report},
             folder_);
    return read_report(folder_ / report);
  };
  std::vector<Placement> placements;
  constexpr int kAtOnce = 2;
  for (int first = 1; first <= seeds; first += kAtOnce) {
    std::vector<std::future<Placement>> running;
    for (int seed = first; seed < std::min(first + kAtOnce, seeds + 1); ++seed) {
      running.push_back(std::async(std::launch::async, place_once, seed));
    }
    for (std::future<Placement>& one : running) placements.push_back(one.get());
  }
  std::sort(placements.begin(), placements.end(),
            [](const Placement& a, const Placement& b) { return a.clock_ns < b.clock_ns; });
  MeasuredDesign design = area_;
  const Placement& median = placements[placements.size() / 2];
  design.clock_ns = median.clock_ns;
  design.limited_by = median.limited_by;
  design.slowest_ns = placements.back().clock_ns;
  return design;
}

std::string synthesis_tools() {
  std::vector<std::string> tools;
  static const std::regex number("[0-9]+\\.[0-9]+");
  for (const char* tool : {"yosys", "nextpnr-ice40"}) {
    const ProcessOutput output = run_process({tool, "--version"});
    std::smatch version;
    const bool known = std::regex_search(output.text, version, number);
    tools.push_back(fmt::format("{} {}", tool, known ? version[0].str() : "of unknown version"));
  }
  return fmt::format("{}", fmt::join(tools, " and "));
}

}  // namespace phongpipe
