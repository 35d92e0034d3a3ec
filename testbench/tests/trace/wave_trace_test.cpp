// trace: windows of waveforms show what happened, change nothing, and come with views that are
// true.
#include "testbench/trace/wave_trace.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <set>

#include "model/files/text_file.h"
#include "model/fixed/model_frame.h"
#include "sim/pipeline.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cosim/stream_checker.h"
#include "testbench/rtl/tool_folder.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"
#include "testbench/trace/trace_diff.h"
#include "testbench/trace/views.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class Traces : public testing::Test {
 protected:
  explicit Traces(const std::vector<std::string>& settings = {})
      : folder_(fs::path(testing::TempDir()) / fmt::format("phongpipe-trace-{}", getpid())),
        hardware_(load_hardware("default", settings)),
        frame_(load_named_scene("sphere", {"scene.image.width=64", "scene.image.height=64",
                                           "scene.object.0.segments=[10,6]"}),
               hardware_.formats, hardware_.setup),
        library_(frame_.setup.configuration, build()) {
    fs::create_directories(folder_);
  }
  ~Traces() override { fs::remove_all(folder_); }

  static RtlBuildOptions build() {
    RtlBuildOptions options;
    options.build = RtlBuild::signals;
    options.destination = PHONGPIPE_RTL_CACHE;
    return options;
  }
  RecordedTrace record(const TraceTarget& target, const std::string& name,
                       const TraceOptions& options = {}) {
    windows_ = find_windows(frame_, hardware_, target, options);
    return record_trace(frame_, hardware_, library_, windows_, target, options, folder_ / name);
  }
  static TraceTarget whole_frame() {
    TraceTarget target;
    target.frame = true;
    return target;
  }
  static TraceTarget pixel(int x, int y) {
    TraceTarget target;
    target.pixels = {{x, y}};
    return target;
  }

  fs::path folder_;
  Hardware hardware_;
  PreparedFrame frame_;
  RtlLibrary library_;
  std::vector<CycleWindow> windows_;
};

// All values of a variable with their times.
std::map<std::uint64_t, std::string> values_of(const fs::path& file, const std::string& name) {
  std::map<std::uint64_t, std::string> values;
  std::vector<WaveVariable> variables;
  WaveReader::read(
      file, [&](const std::vector<WaveVariable>& declared) { variables = declared; },
      [&](std::uint64_t ps, std::size_t index, const std::string& value) {
        if (variables[index].full_name() == name) values[ps] = value;
      });
  return values;
}

TEST_F(Traces, APixelIsInItsWindowWithItsColor) {
  const ModelFrame model = run_model(frame_.setup);
  const RecordedTrace trace = record(pixel(30, 31), "a.vcd");
  ASSERT_EQ(trace.markers.size(), 2U);
  EXPECT_EQ(trace.markers[0].name, "enters 30,31");
  EXPECT_EQ(trace.markers[1].name, "leaves 30,31");
  EXPECT_GE(trace.markers[1].cycle - trace.markers[0].cycle,
            frame_.setup.configuration.latency_cycles() - 1);
  ASSERT_EQ(windows_.size(), 1U);
  EXPECT_LE(windows_[0].first + 32, trace.markers[0].cycle);
  EXPECT_EQ(windows_[0].last, trace.markers[1].cycle + 32);
  const auto color = model.framebuffer.color(31 * 64 + 30);
  const std::uint64_t leaves = static_cast<std::uint64_t>(trace.markers[1].cycle) * trace.period_ps;
  for (const char* side : {"rtl", "systemc"}) {
    const auto values =
        values_of(folder_ / "a.vcd", fmt::format("phongpipe.{}.pixel_datapath.pixel_color", side));
    const auto after = values.upper_bound(leaves);
    ASSERT_NE(after, values.begin()) << side;
    EXPECT_EQ(std::stoul(std::prev(after)->second, nullptr, 2), color) << side;
  }
  EXPECT_LT(fs::file_size(folder_ / "a.vcd"), 200'000U);
}

// A pixel may wait longer than the margin before it leaves.
TEST_F(Traces, TheWindowBeginsBeforeThePixelUnderBackPressure) {
  int longest_wait = 0;
  for (const auto& [x, y] : {std::pair(30, 31), std::pair(40, 30), std::pair(30, 50)}) {
    TraceTarget target = pixel(x, y);
    target.margin_cycles = 0;
    TraceOptions options;
    options.simulation.stall_percent = 60;
    const RecordedTrace trace = record(target, "a.fst", options);
    ASSERT_EQ(trace.markers.size(), 2U);
    EXPECT_EQ(trace.markers[0].name, fmt::format("enters {},{}", x, y));
    EXPECT_LE(windows_.at(0).first, trace.markers[0].cycle);
    EXPECT_EQ(windows_.at(0).last, trace.markers[1].cycle);
    longest_wait =
        std::max(longest_wait, static_cast<int>(trace.markers[1].cycle - trace.markers[0].cycle) -
                                   frame_.setup.configuration.latency_cycles());
  }
  EXPECT_GT(longest_wait, 0);
}

TEST_F(Traces, AWindowIsPartOfTheWholeTraceInBothFormats) {
  record(whole_frame(), "whole.fst");
  TraceTarget target;
  target.span = 40;
  for (const char* name : {"window.fst", "window.vcd"}) {
    record(target, name);
    const TraceDiff diff = diff_traces(folder_ / "whole.fst", folder_ / name);
    ASSERT_EQ(diff.comparisons.size(), 2U) << "rtl and systemc";
    EXPECT_TRUE(diff.same()) << name;
    for (const TraceComparison& c : diff.comparisons) {
      EXPECT_GT(c.compared, 10U);
      EXPECT_GT(c.signals, 20U);
      EXPECT_EQ(c.compared, c.b_pixels);
      EXPECT_GT(c.a_pixels, c.b_pixels);
    }
  }
}

TEST_F(Traces, ManyWindowsAreOneFile) {
  TraceTarget target = pixel(20, 30);
  target.pixels.push_back({40, 40});
  target.margin_cycles = 3;
  record(target, "two.fst");
  EXPECT_EQ(windows_.size(), 2U);
  const TraceDiff diff = diff_traces(folder_ / "two.fst", folder_ / "two.fst");
  ASSERT_EQ(diff.comparisons.size(), 1U) << "RTL with SystemC";
  EXPECT_TRUE(diff.same());
}

// Pixels of the serial datapath are not in every stage, and several clocks apart; those of a wide
// one are in lanes.
class TracesOfKinds : public Traces, public testing::WithParamInterface<const char*> {
 protected:
  TracesOfKinds() : Traces({fmt::format("datapath.kind={}", GetParam())}) {}
};
TEST_P(TracesOfKinds, AreComparedWindowByWindow) {
  record(whole_frame(), "whole.fst");
  const RecordedTrace trace = record(pixel(30, 31), "window.vcd");
  ASSERT_EQ(trace.markers.size(), 2U);
  // From the entrance into the lanes, where the datapath has some.
  const DatapathConfiguration& datapath = frame_.setup.configuration;
  const int latency = datapath.latency_cycles() - datapath.lane_stages();
  EXPECT_GE(trace.markers[1].cycle - trace.markers[0].cycle, latency - 1);
  for (const auto& [a, b] : {std::pair("whole.fst", "window.vcd"), {"whole.fst", "whole.fst"}}) {
    const TraceDiff diff = diff_traces(folder_ / a, folder_ / b);
    EXPECT_TRUE(diff.same()) << a << " and " << b;
    for (const TraceComparison& c : diff.comparisons) {
      EXPECT_GT(c.compared, 2U);
      EXPECT_GT(c.signals, 20U);
      EXPECT_EQ(c.compared, c.b_pixels);
      EXPECT_EQ(c.a_latency_cycles, latency);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, TracesOfKinds, testing::Values("serial", "wide2", "wide4"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_F(Traces, TracingChangesNothing) {
  TraceOptions options;
  options.simulation.stall_percent = 30;
  options.simulation.stall_seed = 5;
  const RecordedTrace trace = record(pixel(30, 31), "a.fst", options);
  Child child([&] {
    StreamHash hash;
    SimulationOptions simulation = options.simulation;
    simulation.observe = [&](const ShadedPixel* pixels, const std::int64_t* cycles,
                             std::size_t count) { hash.add(pixels, cycles, count); };
    const SimulationResult result = simulate(frame_.setup, hardware_.pipeline, simulation);
    const Fingerprint f = hash.fingerprint();
    return fmt::format("{} {}", result.frame_cycles, f.stream_hash ^ f.cycles_hash);
  });
  EXPECT_EQ(child.get(), fmt::format("{} {}", trace.frame_cycles, trace.stream_hash));
}

TEST_F(Traces, ViewsNameOnlyWhatIsThere) {
  const RecordedTrace trace = record(pixel(30, 31), "a.fst");
  const WaveReader file = WaveReader::read(
      folder_ / "a.fst", [](auto...) {}, [](auto...) {});
  std::set<std::string> names, declared;
  for (const WaveVariable& variable : file.variables) names.insert(variable.full_name());
  for (const WaveVariable& variable : trace.variables) {
    declared.insert(variable.full_name() + variable.range());
  }
  EXPECT_EQ(names.size(), declared.size());
  std::size_t shown = 0, fixed_points = 0;
  std::string_view line;
  const std::string gtkwave = gtkwave_view(trace, windows_[0], folder_ / "a.fst");
  for (LineReader lines(gtkwave); lines.next(line);) {
    fixed_points += line.substr(0, 15) == "[fpshift_count]" ? 1 : 0;
    if (line.substr(0, 10) != "phongpipe.") continue;
    EXPECT_EQ(declared.count(std::string(line)), 1U) << line;
    ++shown;
  }
  EXPECT_GT(shown, 100U);
  EXPECT_GT(fixed_points, 10U);
  const std::string surfer = surfer_view(trace);
  std::size_t added = 0, formats = 0;
  for (LineReader lines(surfer); lines.next(line);) {
    formats += line.substr(0, 16) == "item_set_format " ? 1 : 0;
    constexpr std::string_view kAdd = "variable_add ";
    if (line.substr(0, kAdd.size()) != kAdd) continue;
    EXPECT_EQ(names.count(std::string(line.substr(kAdd.size()))), 1U) << line;
    ++added;
  }
  EXPECT_EQ(added, shown);
  EXPECT_EQ(formats, fixed_points);
}

TEST_F(Traces, WordsAreDeclaredByTheirWeightsAndShownInLsb) {
  record(pixel(30, 31), "a.vcd");
  const std::string text = read_whole_file(folder_ / "a.vcd");
  const std::size_t at = text.find(" s4_v [9:-16] $end");
  EXPECT_NE(at, std::string::npos) << text.substr(0, 3000);
  const std::string name = "pixel_datapath.channel[0].diffuse.diffuse_series.s4_v";
  const auto words = values_of(folder_ / "a.vcd", "phongpipe.rtl." + name);
  const auto numbers = values_of(folder_ / "a.vcd", "phongpipe.lsb.rtl." + name);
  ASSERT_GT(numbers.size(), 20U);
  for (const auto& [ps, number] : numbers) {
    const std::string& bits = words.at(ps);
    std::int64_t word = 0;
    for (const char bit : bits) word = 2 * word + (bit == '1' ? 1 : 0);
    word = wrap_to(word, static_cast<int>(bits.size()));
    EXPECT_EQ(std::stod(number), static_cast<double>(word) / 65536);
  }
}

TEST_F(Traces, WhatIsNotThereIsRefusedWithWhatIs) {
  const auto refusal = [&](const TraceTarget& target) {
    try {
      find_windows(frame_, hardware_, target, {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  TraceTarget target;
  target.triangle = 10'000;
  EXPECT_NE(refusal(target).find("the scene has the triangles 0 to"), std::string::npos);
  target = {};
  target.span = 100'000;
  EXPECT_NE(refusal(target).find("the frame has the spans 0 to"), std::string::npos);
  target = {};
  target.cycles = CycleWindow{10, 1'000'000'000};
  EXPECT_NE(refusal(target).find("the frame has the cycles 0:"), std::string::npos);
}

TEST_F(Traces, AFaultIsFoundByComparingTraces) {
  const fs::path rtl = folder_ / "rtl";
  fs::create_directories(rtl);
  for (const auto& entry : fs::directory_iterator(PHONGPIPE_HARDWARE)) {
    if (entry.is_regular_file()) fs::copy(entry.path(), rtl);
  }
  std::string text = read_whole_file(rtl / "pixel_datapath.sv");
  const std::string correct = "highlight[2], s1_highlight";
  text.replace(text.find(correct), correct.size(), correct + " ^ (s1_x == 33 && s1_y == 31)");
  write_text(rtl / "pixel_datapath.sv", text);
  RtlBuildOptions options = build();
  options.sources = rtl;
  options.destination = folder_;
  const RtlLibrary faulty(frame_.setup.configuration, options);
  const TraceTarget target = pixel(33, 31);
  record(target, "good.fst");
  record_trace(frame_, hardware_, faulty, windows_, target, {}, folder_ / "bad.fst");
  const TraceDiff diff = diff_traces(folder_ / "good.fst", folder_ / "bad.fst");
  EXPECT_FALSE(diff.same());
  for (const TraceComparison& c : diff.comparisons) {
    ASSERT_EQ(c.first.has_value(), c.a_scope == "phongpipe.rtl") << c.a_scope;
    if (!c.first) continue;
    EXPECT_EQ(c.first->signal, "pixel_datapath.s2_highlight");
    EXPECT_EQ(c.first->x, 33);
    EXPECT_EQ(c.first->y, 31);
  }
}

// What Icarus Verilog records of the installed RTL, or of RTL with a fault.
TEST_F(Traces, OfOtherToolsAreComparedByTheirNames) {
  const auto record_with_iverilog = [&](const std::string& name, const std::string& fault) {
    std::vector<std::string> command = {"iverilog",
                                        "-g2012",
                                        "-s",
                                        "iverilog_tb",
                                        "-o",
                                        "tb.vvp",
                                        "-I",
                                        PHONGPIPE_HARDWARE,
                                        PHONGPIPE_SOURCES "/testbench/tests/trace/iverilog_tb.sv"};
    for (const fs::path& source : rtl_sources(PHONGPIPE_HARDWARE)) {
      if (source.extension() != ".sv") continue;
      std::string text = read_whole_file(source);
      const std::string correct = "integer_part;\n    new_word";
      const std::size_t at = text.find(correct);
      if (!fault.empty() && at != std::string::npos) text.replace(at, 12, fault);
      write_text(folder_ / source.filename(), text);
      command.push_back(source.filename().string());
    }
    ASSERT_EQ(run_process(command, folder_).status, 0);
    ASSERT_EQ(run_process({"vvp", "tb.vvp"}, folder_).status, 0);
    fs::rename(folder_ / "iverilog.vcd", folder_ / name);
  };
  record_with_iverilog("a.vcd", "");
  record_with_iverilog("b.vcd", "integer_part ^ (integer_part[1:0] == 3)");
  EXPECT_THROW(diff_traces(folder_ / "a.vcd", folder_ / "a.vcd"), InputError)
      << "there is one implementation in it";
  const TraceDiff diff = diff_traces(folder_ / "a.vcd", folder_ / "b.vcd");
  ASSERT_EQ(diff.comparisons.size(), 1U);
  ASSERT_TRUE(diff.comparisons[0].first.has_value());
  EXPECT_EQ(diff.comparisons[0].first->signal, "pixel_datapath.color.specular.rom.s5_address");
  EXPECT_EQ(diff.comparisons[0].a_pixels, 12U);
  EXPECT_EQ(diff.comparisons[0].a_latency_cycles, kDatapathLatency);
  record(pixel(30, 31), "ours.fst");
  const TraceDiff none = diff_traces(folder_ / "a.vcd", folder_ / "ours.fst");
  EXPECT_FALSE(none.same());
  EXPECT_EQ(none.comparisons[0].compared, 0U) << "they have no pixel in common";
}

TEST_F(Traces, FilesThatWereCutAreReadAsFarAsTheyGo) {
  record(pixel(30, 31), "a.vcd");
  record(whole_frame(), "a.fst");
  const std::string vcd = read_whole_file(folder_ / "a.vcd");
  write_text(folder_ / "cut.vcd", vcd.substr(0, vcd.size() * 2 / 3));
  const TraceDiff diff = diff_traces(folder_ / "a.vcd", folder_ / "cut.vcd");
  EXPECT_TRUE(diff.same());
  EXPECT_TRUE(diff.a_complete);
  EXPECT_FALSE(diff.b_complete);
  EXPECT_LT(diff.comparisons.front().b_pixels, diff.comparisons.front().a_pixels);
  const std::string fst = read_whole_file(folder_ / "a.fst");
  write_text(folder_ / "cut.fst", fst.substr(0, fst.size() * 2 / 3));
  const TraceDiff blocks = diff_traces(folder_ / "a.fst", folder_ / "cut.fst");
  EXPECT_TRUE(blocks.same());
  EXPECT_FALSE(blocks.b_complete);
  EXPECT_GT(blocks.comparisons.front().b_pixels, 0U);
  EXPECT_LT(blocks.comparisons.front().b_pixels, blocks.comparisons.front().a_pixels);
  write_text(folder_ / "names.fst", fst.substr(0, 500));
  write_text(folder_ / "none.vcd", "hello\n");
  write_text(folder_ / "names.vcd",
             "$timescale 1 ns $end\n$scope module top $end\n"
             "$var wire 1 ! clk $end\n$upscope $end\n$enddefinitions $end\n");
  for (const char* name : {"names.fst", "none.vcd", "names.vcd", "absent.vcd"}) {
    EXPECT_THROW(diff_traces(folder_ / "a.vcd", folder_ / name), InputError) << name;
  }
}

}  // namespace
}  // namespace phongpipe
