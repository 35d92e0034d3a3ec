#include "testbench/synthesis/place_and_route.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>
#include <regex>

#include "model/files/text_file.h"
#include "model/fixed/constants.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

using Port = SynthesisTarget::Port;

// The words of a span, or the digits of them.
std::vector<Port> span_words_of(const DatapathConfiguration& c) {
  if (c.kind == DatapathKind::serial) {
    return {{"span_v", kDigitBits},
            {"span_d1", kDigitBits},
            {"span_d2", kDigitBits},
            {"span_level", kDigitBits}};
  }
  const int diffuse = c.diffuse_width(), specular = c.specular_width(), channels = c.channels;
  return {{"span_diffuse_v", channels * diffuse},
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
          {"span_cue_d1", kCueWidth}};
}

std::vector<Port> inputs_of(const DatapathConfiguration& c) {
  std::vector<Port> ports = {{"reset", 1},
                             {"span_valid", 1},
                             {"span_x", kCoordinateBits},
                             {"span_y", kCoordinateBits},
                             {"span_length", kLengthBits},
                             {"span_first_pass", 1},
                             {"span_step_diffuse", 1},
                             {"span_step_specular", 1},
                             {"span_highlight", 1},
                             {"cue_color", c.channels * kOutputBits},
                             {"rom_write", 1},
                             {"rom_address", c.rom_address_bits},
                             {"rom_data", c.channels * c.rom_data_bits},
                             {"pixel_ready", 1}};
  const std::vector<Port> words = span_words_of(c);
  ports.insert(ports.end(), words.begin(), words.end());
  return ports;
}

std::vector<Port> outputs_of(const DatapathConfiguration& c) {
  std::vector<Port> ports = {{"span_ready", 1},
                             {"pixel_valid", c.lanes()},
                             {"pixel_x", kCoordinateBits},
                             {"pixel_y", kCoordinateBits},
                             {"pixel_color", c.lanes() * c.channels * kOutputBits}};
  if (c.kind == DatapathKind::serial) {
    ports.push_back({"span_series", kSeriesBits});
    ports.push_back({"span_digit", kDigitPlaceBits});
  }
  return ports;
}

// All ports between registers: a chain that fills the inputs from a pin, and one that empties the
// outputs to a pin.
std::string harness(const SynthesisTarget& target) {
  int inputs = 0, outputs = 0;
  std::string connections;
  for (const Port& port : target.inputs) {
    connections += fmt::format(", .{}(in[{}+:{}])", port.name, inputs, port.width);
    inputs += port.width;
  }
  for (const Port& port : target.outputs) {
    connections += fmt::format(", .{}(out[{}+:{}])", port.name, outputs, port.width);
    outputs += port.width;
  }
  std::vector<std::string> parameters;
  for (const auto& [name, value] : target.parameters) {
    parameters.push_back(fmt::format(".{}({})", name, value));
  }
  return fmt::format(
      "module harness(input clk, input fill, input take, output empty);\n"
      "  reg [{0}:0] in;\n  reg [{1}:0] taken;\n  reg taking;\n  wire [{1}:0] out;\n"
      "  assign empty = taken[0];\n"
      "  always @(posedge clk) begin\n"
      "    in <= {{in, fill}};\n    taking <= take;\n    taken <= taking ? out : taken >> 1;\n"
      "  end\n  {2} #({3}) dut (.clk(clk){4});\nendmodule\n",
      inputs - 1, outputs - 1, target.module, fmt::join(parameters, ", "), connections);
}

// Throws ToolError if it fails, InputError if the design is too large for the device.
void run_tool(const std::vector<std::string>& command, const ToolFolder& tools) {
  const ProcessOutput output = tools.run(command);
  if (output.status == 0) return;
  std::smatch line;
  static const std::regex error("ERROR: ([^\n]*)");
  std::string message = "it failed without a message";
  if (std::regex_search(output.text, line, error)) message = line[1];
  const auto says = [&message](const char* part) { return message.find(part) != message.npos; };
  if (says("no BELs remaining") || says("Failed to expand region")) {
    throw InputError(
        fmt::format("the design is too large for the device: reduce widths, tables or channels, or "
                    "choose another card; {} said: {}",
                    command.front(), message));
  }
  throw ToolError(fmt::format("{} said: {}", command.front(), message));
}

struct Placement {
  double clock_ns = 0;
  std::string limited_by;
};

Placement read_report(const fs::path& file,
                      const std::vector<std::pair<std::string, std::string>>& blocks) {
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
    const std::string cell = path.at("path").back().at("to").at("cell");
    placement.limited_by = "control";
    for (const auto& [part, block] : blocks) {
      if (cell.find(part) != std::string::npos) placement.limited_by = block;
    }
  }
  if (placement.clock_ns <= 0) throw ToolError("nextpnr-ice40 reported no clock");
  return placement;
}

}  // namespace

SynthesisTarget datapath_target(const DatapathConfiguration& configuration) {
  return {std::string(traits(configuration.kind).rtl_module),
          rtl_parameters(configuration),
          inputs_of(configuration),
          outputs_of(configuration),
          {{"_lanes.", "series_lanes"},
           {"differencer.", "serial_differencer"},
           {".level.", "digit_register"},
           {"_series.",
            configuration.kind == DatapathKind::serial ? "digit_register" : "forward_differencer"},
           {".rom.", "exponent_rom"},
           {".summation.", "color_sum"},
           {".multiplier.", "depth_cue"},
           {".queue.", "pixel_queue"}},
          rtl_parameters_text(configuration)};
}

Netlist::Netlist(const SynthesisTarget& target, const fs::path& sources)
    : tools_(fs::temp_directory_path()), blocks_(target.blocks) {
  std::string files;
  for (const RtlSource& source : tools_.copy_sources(sources)) {
    if (source.original.extension() == ".sv") files += " " + source.copy;
  }
  write_text(tools_.path() / "harness.v", harness(target));
  std::string sets;
  for (const auto& [parameter, value] : target.parameters) {
    sets += fmt::format(" -set {} {}", parameter, value);
  }
  // Once alone, for its area, and once between registers. ABC runs twice (-abc2): after once, some
  // designs have a level of logic more than their neighbours, and a clock that is 15 % slower.
  run_tool({"yosys", "-q", "-p",
            fmt::format("read_verilog -sv -I{1}{0}; chparam{2} {3}; synth_ice40 -abc2 -top {3}; "
                        "tee -q -o area.json stat -json; design -reset; read_verilog -sv -I{1}{0} "
                        "harness.v; synth_ice40 -abc2 -top harness -json harness.json",
                        files, ToolFolder::kSources, sets, target.module)},
           tools_);
  const auto area = nlohmann::json::parse(read_whole_file(tools_.path() / "area.json"));
  area_.parameters = target.name.empty() ? parameters_text(target.parameters) : target.name;
  for (const auto& [cell, count] : area.at("design").at("num_cells_by_type").items()) {
    if (cell == "SB_LUT4") area_.luts += count.get<int>();
    if (cell == "SB_CARRY") area_.carries += count.get<int>();
    if (cell.rfind("SB_DFF", 0) == 0) area_.registers += count.get<int>();
    if (cell.rfind("SB_RAM40", 0) == 0) area_.block_rams += count.get<int>();
  }
}

MeasuredDesign Netlist::place(const std::string& device, const std::string& package,
                              int seeds) const {
  const auto place_once = [&](int seed) {
    const std::string report = fmt::format("{}-{}.json", device, seed);
    run_tool({"nextpnr-ice40", "-q", "--" + device, "--package", package, "--json", "harness.json",
              "--seed", std::to_string(seed), "--freq", "200", "--timing-allow-fail",
              "--pcf-allow-unconstrained", "--report", report},
             tools_);
    return read_report(tools_.path() / report, blocks_);
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
