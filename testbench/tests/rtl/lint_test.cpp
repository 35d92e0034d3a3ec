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

ProcessOutput verilator(const std::string& top, const Parameters& parameters) {
  std::vector<std::string> command = {"verilator",    "--lint-only", "-Wall",
                                      "--top-module", top,           "-I" + kFolder};
  for (const auto& [name, value] : parameters)
    command.push_back(fmt::format("-G{}={}", name, value));
  for (const std::string& module : modules()) command.push_back(module);
  return run_process(command);
}

ProcessOutput iverilog(const std::string& top, const Parameters& parameters) {
  // No output file: iverilog makes what it writes executable, even /dev/null.
  std::vector<std::string> command = {"iverilog", "-g2012", "-Wall", "-I" + kFolder,
                                      "-s",       top,      "-t",    "null"};
  for (const auto& [name, value] : parameters) {
    command.push_back(fmt::format("-P{}.{}={}", top, name, value));
  }
  for (const std::string& module : modules()) command.push_back(module);
  return run_process(command);
}

ProcessOutput yosys(const std::string& top, const Parameters& parameters) {
  std::string sets;
  for (const auto& [name, value] : parameters) sets += fmt::format(" -set {} {}", name, value);
  return run_process({"yosys", "-q", "-p",
                      fmt::format("read_verilog -sv -I{0} {1}; chparam{2} {3}; "
                                  "hierarchy -check -top {3}; proc; check -assert; "
                                  "synth -run coarse; check -assert",
                                  kFolder, fmt::join(modules(), " "), sets, top)});
}

void expect_clean(const ProcessOutput& output, const DatapathConfiguration& c) {
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(output.text, "") << fmt::format("{}", fmt::join(rtl_parameters(c), " "));
}

bool is_legal(const DatapathConfiguration& c) {
  return !(c.specular && !c.diffuse && c.gate == GateSource::diffuse);
}

std::string module_of(const DatapathConfiguration& c) {
  return std::string(traits(c.kind).rtl_module);
}

// visit(configuration) for every kind of datapath and every legal combination of blocks.
template <typename Visit>
void for_each_block_combination(Visit visit) {
  DatapathConfiguration c;
  for (const DatapathKindTraits& kind : kDatapathKinds) {
    c.kind = kind.kind;
    for (int blocks = 0; blocks < 8; ++blocks) {
      c.diffuse = (blocks & 1) != 0;
      c.specular = (blocks & 2) != 0;
      c.depth_cue = (blocks & 4) != 0;
      for (const int channels : {1, 3}) {
        c.channels = channels;
        for (const GateSource gate : {GateSource::off, GateSource::diffuse, GateSource::series}) {
          c.gate = gate;
          if (is_legal(c)) visit(c);
        }
      }
    }
  }
}

TEST(Lint, VerilatorTakesEveryCombinationOfBlocks) {
  for_each_block_combination([](const DatapathConfiguration& c) {
    expect_clean(verilator(module_of(c), rtl_parameters(c)), c);
  });
}

// Where all formats are at the lowest and at the highest value that the table of settings has.
TEST(Lint, VerilatorTakesTheEndsOfEveryRange) {
  DatapathConfiguration c;
  for (const DatapathKindTraits& kind : kDatapathKinds) {
    c.kind = kind.kind;
    for (const bool highest : {false, true}) {
      for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
        if (!setting.rtl_parameter.empty()) setting.put(c, highest ? setting.high : setting.low);
      }
      for (const int channels : {1, 3}) {
        c.channels = channels;
        expect_clean(verilator(module_of(c), rtl_parameters(c)), c);
      }
    }
  }
}

TEST(Lint, IcarusAndYosysTakeEveryBlock) {
  for_each_block_combination([](const DatapathConfiguration& c) {
    const GateSource usual = c.specular && !c.diffuse ? GateSource::series : GateSource::diffuse;
    if (c.channels != 3 || c.gate != usual) return;
    expect_clean(iverilog(module_of(c), rtl_parameters(c)), c);
    expect_clean(yosys(module_of(c), rtl_parameters(c)), c);
  });
}

// An illegal parameter stops elaboration in every tool, at a name that says which one it is.
TEST(Lint, AnIllegalParameterNamesItself) {
  std::string top = "pixel_datapath";
  const auto expect_named = [&top](const Parameters& parameters, const std::string& name) {
    for (const ProcessOutput& output :
         {verilator(top, parameters), iverilog(top, parameters), yosys(top, parameters)}) {
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
  top = "pixel_datapath_serial";
  expect_named({{"CHANNELS", 2}}, "CHANNELS_must_be_1_or_3");
  expect_named({{"ROM_DATA_BITS", 13}}, "ROM_DATA_BITS_must_be_4_to_12");
  top = "pixel_datapath_wide";
  expect_named({{"LANES", 3}}, "LANES_must_be_2_or_4");
  expect_named({{"ROM_DATA_BITS", 13}}, "ROM_DATA_BITS_must_be_4_to_12");
  expect_named({{"DIFFUSE", 0}, {"SPECULAR", 1}, {"GATE", 1}}, "GATE_diffuse_needs_DIFFUSE");
}

}  // namespace
}  // namespace phongpipe
