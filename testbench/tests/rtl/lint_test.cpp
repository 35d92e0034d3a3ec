// The RTL is clean in every tool that takes it: at the corners of its parameters, and with any of
// the effects' blocks left out.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "testbench/cases/format_range.h"
#include "testbench/rtl/rtl_builder.h"
#include "testbench/rtl/tool_folder.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

const std::string kFolder = PHONGPIPE_HARDWARE;

using Parameters = std::vector<std::pair<std::string_view, int>>;

std::vector<std::string> modules() {
  std::vector<std::string> files;
  for (const auto& file : rtl_sources(kFolder)) {
    if (file.extension() == ".sv") files.push_back(file.string());
  }
  return files;
}

ProcessOutput verilator(const Parameters& parameters) {
  std::vector<std::string> command = {"verilator",    "--lint-only",    "-Wall",
                                      "--top-module", "pixel_datapath", "-I" + kFolder};
  for (const auto& [name, value] : parameters)
    command.push_back(fmt::format("-G{}={}", name, value));
  for (const std::string& module : modules()) command.push_back(module);
  return run_process(command);
}

ProcessOutput iverilog(const Parameters& parameters) {
  std::vector<std::string> command = {"iverilog", "-g2012",         "-Wall", "-I" + kFolder,
                                      "-s",       "pixel_datapath", "-o",    "/dev/null"};
  for (const auto& [name, value] : parameters) {
    command.push_back(fmt::format("-Ppixel_datapath.{}={}", name, value));
  }
  for (const std::string& module : modules()) command.push_back(module);
  return run_process(command);
}

ProcessOutput yosys(const Parameters& parameters) {
  std::string sets;
  for (const auto& [name, value] : parameters) sets += fmt::format(" -set {} {}", name, value);
  return run_process({"yosys", "-q", "-p",
                      fmt::format("read_verilog -sv -I{} {}; chparam{} pixel_datapath; "
                                  "hierarchy -check -top pixel_datapath; proc; check -assert; "
                                  "synth -run coarse; check -assert",
                                  kFolder, fmt::join(modules(), " "), sets)});
}

void expect_clean(const ProcessOutput& output, const DatapathConfiguration& c) {
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(output.text, "") << fmt::format("{}", fmt::join(rtl_parameters(c), " "));
}

bool is_legal(const DatapathConfiguration& c) {
  return !(c.specular && !c.diffuse && c.gate == GateSource::diffuse);
}

// visit(configuration) for every legal combination of blocks.
template <typename Visit>
void for_each_block_combination(Visit visit) {
  for (int blocks = 0; blocks < 8; ++blocks) {
    for (const int channels : {1, 3}) {
      for (const GateSource gate : {GateSource::off, GateSource::diffuse, GateSource::series}) {
        DatapathConfiguration c;
        c.channels = channels;
        c.gate = gate;
        c.diffuse = (blocks & 1) != 0;
        c.specular = (blocks & 2) != 0;
        c.depth_cue = (blocks & 4) != 0;
        if (is_legal(c)) visit(c);
      }
    }
  }
}

TEST(Lint, VerilatorTakesEveryCombinationOfBlocks) {
  for_each_block_combination(
      [](const DatapathConfiguration& c) { expect_clean(verilator(rtl_parameters(c)), c); });
}

// Where all formats are at the lowest and at the highest value that the table of settings has.
TEST(Lint, VerilatorTakesTheEndsOfEveryRange) {
  for (const bool highest : {false, true}) {
    for (const int channels : {1, 3}) {
      DatapathConfiguration c;
      c.channels = channels;
      for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
        if (!setting.rtl_parameter.empty()) setting.put(c, highest ? setting.high : setting.low);
      }
      expect_clean(verilator(rtl_parameters(c)), c);
    }
  }
}

TEST(Lint, IcarusAndYosysTakeEveryBlock) {
  for_each_block_combination([](const DatapathConfiguration& c) {
    const GateSource usual = c.specular && !c.diffuse ? GateSource::series : GateSource::diffuse;
    if (c.channels != 3 || c.gate != usual) return;
    expect_clean(iverilog(rtl_parameters(c)), c);
    expect_clean(yosys(rtl_parameters(c)), c);
  });
}

// An illegal parameter stops elaboration in every tool, at a name that says which one it is.
TEST(Lint, AnIllegalParameterNamesItself) {
  const auto expect_named = [](const Parameters& parameters, const std::string& name) {
    for (const ProcessOutput& output :
         {verilator(parameters), iverilog(parameters), yosys(parameters)}) {
      EXPECT_NE(output.status, 0);
      EXPECT_NE(output.text.find(name), std::string::npos) << name << " in\n" << output.text;
    }
  };
  for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
    if (setting.rtl_parameter.empty()) continue;
    const std::string name =
        fmt::format("{}_must_be_{}_to_{}", setting.rtl_parameter, setting.low, setting.high);
    expect_named({{setting.rtl_parameter, setting.low - 1}}, name);
    expect_named({{setting.rtl_parameter, setting.high + 1}}, name);
  }
  expect_named({{"CHANNELS", 2}}, "CHANNELS_must_be_1_or_3");
  expect_named({{"GATE", 3}}, "GATE_must_be_0_to_2");
  expect_named({{"DIFFUSE", 0}, {"SPECULAR", 1}, {"GATE", 1}}, "GATE_diffuse_needs_DIFFUSE");
}

}  // namespace
}  // namespace phongpipe
