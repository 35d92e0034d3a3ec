// RTL pixel_datapath ≡ model, for values, and ≡ SystemC's pipeline, for every clock of its ports.
#include "model/fixed/pixel_datapath.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <set>

#include "sim/signals/datapath_signals.h"
#include "testbench/cases/random_datapath.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/rtl/rtl_signals.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

RtlBuildOptions build_options() {
  RtlBuildOptions options;
  options.destination = PHONGPIPE_RTL_CACHE;
  return options;
}

DatapathConfiguration configured(int channels, int diffuse, int specular, int address, int data,
                                 GateSource gate) {
  DatapathConfiguration c;
  c.channels = channels;
  c.diffuse_fraction_bits = diffuse;
  c.specular_fraction_bits = specular;
  c.rom_address_bits = address;
  c.rom_data_bits = data;
  c.gate = gate;
  return c;
}

DatapathConfiguration of_blocks(DatapathConfiguration c, bool diffuse, bool specular,
                                bool depth_cue) {
  c.diffuse = diffuse;
  c.specular = specular;
  c.depth_cue = depth_cue;
  return c;
}

DatapathConfiguration laid_out(DatapathConfiguration c, RomLayout layout, int octaves,
                               int guard_bits) {
  c.rom_layout = layout;
  c.rom_octaves = octaves;
  c.specular_guard_bits = guard_bits;
  return c;
}

DatapathConfiguration serial(DatapathConfiguration c) {
  c.kind = DatapathKind::serial;
  return c;
}
DatapathConfiguration wide(int lanes, DatapathConfiguration c) {
  c.kind = lanes == 2 ? DatapathKind::wide2 : DatapathKind::wide4;
  return c;
}

// The presets, the corners of every parameter, and every combination of blocks.
std::vector<DatapathConfiguration> configurations() {
  return {configured(1, 16, 12, 10, 8, GateSource::diffuse),
          configured(3, 16, 12, 10, 8, GateSource::diffuse),
          configured(1, 16, 12, 13, 8, GateSource::diffuse),
          configured(1, 4, 1, 6, 4, GateSource::off),
          configured(3, 4, 25, 13, 12, GateSource::series),
          configured(1, 30, 25, 13, 12, GateSource::series),
          configured(3, 30, 1, 6, 9, GateSource::off),
          of_blocks(configured(1, 16, 12, 10, 8, GateSource::diffuse), true, false, false),
          of_blocks(configured(3, 16, 12, 10, 8, GateSource::series), true, false, true),
          of_blocks(configured(1, 16, 12, 10, 8, GateSource::series), false, true, false),
          of_blocks(configured(3, 30, 12, 10, 10, GateSource::series), false, true, true),
          of_blocks(configured(3, 16, 12, 10, 4, GateSource::off), false, true, true),
          of_blocks(configured(3, 16, 12, 10, 8, GateSource::off), false, false, false),
          of_blocks(configured(1, 16, 12, 10, 8, GateSource::diffuse), false, false, true),
          of_blocks(configured(3, 16, 12, 10, 8, GateSource::diffuse), true, true, true),
          of_blocks(configured(1, 30, 25, 13, 12, GateSource::series), true, true, true),
          of_blocks(configured(1, 4, 1, 6, 12, GateSource::off), true, true, true),
          laid_out(configured(3, 16, 9, 13, 12, GateSource::diffuse), RomLayout::bipartite, 4, 4),
          laid_out(configured(1, 16, 12, 10, 8, GateSource::series), RomLayout::octave, 2, 8),
          laid_out(configured(1, 30, 14, 13, 12, GateSource::off), RomLayout::bipartite, 1, 12),
          laid_out(configured(3, 4, 1, 6, 4, GateSource::diffuse), RomLayout::bipartite, 4, 4),
          serial(configured(1, 16, 12, 10, 8, GateSource::diffuse)),
          serial(laid_out(configured(3, 16, 9, 13, 12, GateSource::diffuse), RomLayout::bipartite,
                          4, 4)),
          serial(configured(1, 4, 1, 6, 4, GateSource::off)),  // digits that no register has
          serial(configured(1, 30, 25, 13, 12, GateSource::series)),
          serial(of_blocks(configured(1, 4, 1, 6, 8, GateSource::off), false, false, false)),
          serial(of_blocks(configured(3, 16, 12, 10, 4, GateSource::off), false, true, true)),
          serial(of_blocks(configured(1, 16, 12, 10, 8, GateSource::series), false, true, false)),
          serial(of_blocks(configured(3, 30, 25, 13, 12, GateSource::series), true, true, true)),
          wide(2, configured(1, 16, 12, 10, 8, GateSource::diffuse)),
          wide(4, configured(3, 16, 12, 10, 8, GateSource::diffuse)),
          wide(4, laid_out(configured(1, 16, 9, 13, 12, GateSource::diffuse), RomLayout::bipartite,
                           4, 4)),
          wide(2, of_blocks(configured(3, 30, 25, 13, 12, GateSource::series), true, true, true)),
          wide(4, of_blocks(configured(1, 4, 1, 6, 8, GateSource::off), false, false, true))};
}

std::string name_of(const DatapathConfiguration& c) {
  constexpr const char* kLayouts[] = {"", "_octave", "_bipartite"};
  constexpr const char* kKinds[] = {"", "serial_", "wide2_", "wide4_"};
  return fmt::format("{}c{}_d{}_s{}_a{}_w{}_g{}{}{}{}{}", kKinds[static_cast<int>(c.kind)],
                     c.channels, c.diffuse_fraction_bits, c.specular_fraction_bits,
                     c.rom_address_bits, c.rom_data_bits, static_cast<int>(c.gate),
                     c.diffuse ? "" : "_no_diffuse", c.specular ? "" : "_no_specular",
                     c.depth_cue ? "_depth_cue" : "", kLayouts[static_cast<int>(c.rom_layout)]);
}

class SpanSource {
 public:
  SpanSource(const DatapathConfiguration& configuration, unsigned seed)
      : configuration_(configuration),
        random_(seed),
        table_(random_table(random_, configuration)) {}
  const HighlightTable& table() const { return table_; }
  Span next(int longest) { return of_length(random_.integer(1, longest)); }
  Span of_length(int length) { return random_span(random_, configuration_, length); }

 private:
  DatapathConfiguration configuration_;
  Random random_;
  HighlightTable table_;
};

const OutputColor kCueColor = {200, 7, 99};

class PixelDatapathRtl : public ::testing::TestWithParam<DatapathConfiguration> {
 protected:
  PixelDatapathRtl() : library_(GetParam(), build_options()) {}
  RtlLibrary library_;
};

TEST_P(PixelDatapathRtl, ValuesEqualTheModelOnRandomSpans) {
  constexpr unsigned kSeed = 22;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  SpanSource source(GetParam(), kSeed);
  RtlDatapath rtl(library_, kCueColor);
  rtl.load_table(source.table());
  PixelDatapath model(GetParam(), Evaluation::stepping, kCueColor);
  model.load_table(source.table());

  std::vector<RtlSpan> spans;
  std::vector<ShadedPixel> expected;
  std::size_t groups = 0;  // of pixels that enter together
  for (int s = 0; s < 2000; ++s) {
    const Span span = s == 50 ? source.of_length(4096) : source.next(s % 100 == 0 ? 3000 : 40);
    spans.push_back(to_rtl(span));
    const int lanes = GetParam().lanes();
    groups += static_cast<std::size_t>((span.row.length + lanes - 1) / lanes);
    std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length));
    model.shade(span, colors.data());
    for (int i = 0; i < span.row.length; ++i) {
      expected.push_back({static_cast<std::uint16_t>((span.row.x + i) & 0xfff),
                          static_cast<std::uint16_t>(span.row.y),
                          colors[static_cast<std::size_t>(i)]});
    }
  }
  std::vector<RtlPixel> pixels(expected.size());
  const std::uint64_t clocks = library_.interface().run(rtl.rtl(), kCueColor.data(), spans.data(),
                                                        spans.size(), pixels.data());
  // No bubbles between spans, and the latency once.
  EXPECT_EQ(clocks, (groups - 1) * static_cast<std::size_t>(GetParam().interval_cycles()) +
                        static_cast<std::size_t>(GetParam().latency_cycles()) + 1);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(pixels[i].color, expected[i].color) << "pixel " << i;
    ASSERT_EQ(pixels[i].x, expected[i].x) << "pixel " << i;
    ASSERT_EQ(pixels[i].y, expected[i].y) << "pixel " << i;
  }
}

TEST_P(PixelDatapathRtl, EveryClockEqualsSystemCUnderRandomStallsAndResets) {
  constexpr unsigned kSeed = 23;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  SpanSource source(GetParam(), kSeed);
  std::mt19937 random(kSeed);
  RtlDatapath rtl(library_, kCueColor);
  DatapathRegisters systemc(GetParam(), kCueColor);
  DatapathInputs inputs;
  inputs.table = &source.table();
  for (; inputs.rom_address < GetParam().rom_words(); ++inputs.rom_address) {
    rtl.clock(inputs);
    systemc.clock(inputs);
  }
  inputs.table = nullptr;

  Span span;
  std::uint64_t pixels = 0;
  for (int clock = 0; clock < 50'000; ++clock) {
    if (random() % 1000 == 0) {
      rtl.reset();
      systemc.reset();
      inputs.span = nullptr;
    }
    const unsigned mood = static_cast<unsigned>(clock) / 5000 % 3;  // eager, slow in, slow out
    if (inputs.span == nullptr && (mood != 1 || random() % 8 == 0)) {
      span = source.next(12);
      inputs.span = &span;
    }
    inputs.pixel_ready = mood == 0 ? random() % 8 != 0 : mood == 1 || random() % 3 == 0;
    const DatapathOutputs expected = systemc.clock(inputs);
    const DatapathOutputs actual = rtl.clock(inputs);
    ASSERT_EQ(actual.span_ready, expected.span_ready) << "clock " << clock;
    ASSERT_EQ(actual.pixel_valid, expected.pixel_valid) << "clock " << clock;
    if (expected.pixel_valid) {
      ASSERT_EQ(actual.pixels(), expected.pixels()) << "clock " << clock;
      for (int i = 0; i < expected.pixels(); ++i) {
        ASSERT_EQ(actual[i].color, expected[i].color) << "clock " << clock;
        ASSERT_EQ(actual[i].x, expected[i].x) << "clock " << clock;
        ASSERT_EQ(actual[i].y, expected[i].y) << "clock " << clock;
      }
      pixels += inputs.pixel_ready;
    }
    if (expected.span_ready) inputs.span = nullptr;
  }
  // Or nothing was compared.
  EXPECT_GT(pixels, 10'000U / static_cast<unsigned>(GetParam().interval_cycles()));
}

TEST_P(PixelDatapathRtl, FirstPixelTakesExactlyTheLatency) {
  SpanSource source(GetParam(), 24);
  RtlDatapath rtl(library_, kCueColor);
  const Span span = source.next(1);
  DatapathInputs inputs;
  inputs.span = &span;
  inputs.pixel_ready = true;
  ASSERT_TRUE(rtl.clock(inputs).span_ready);
  inputs.span = nullptr;
  for (int clock = 1; clock < GetParam().latency_cycles(); ++clock) {
    EXPECT_FALSE(rtl.clock(inputs).pixel_valid) << "clock " << clock;
  }
  EXPECT_TRUE(rtl.clock(inputs).pixel_valid);
  EXPECT_FALSE(rtl.clock(inputs).pixel_valid);
}

TEST_P(PixelDatapathRtl, ResetDropsPixelsInFlightAndKeepsTheTable) {
  SpanSource source(GetParam(), 25);
  RtlDatapath rtl(library_, kCueColor);
  rtl.load_table(source.table());
  DatapathInputs inputs;
  const Span span = source.next(40);
  inputs.span = &span;
  rtl.clock(inputs);
  rtl.reset();
  inputs.span = nullptr;
  inputs.pixel_ready = true;
  for (int clock = 0; clock < 60; ++clock) ASSERT_FALSE(rtl.clock(inputs).pixel_valid);

  PixelDatapath model(GetParam(), Evaluation::stepping, kCueColor);
  model.load_table(source.table());
  std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length));
  model.shade(span, colors.data());
  std::vector<RtlPixel> pixels(static_cast<std::size_t>(span.row.length));
  const RtlSpan again = to_rtl(span);
  library_.interface().run(rtl.rtl(), kCueColor.data(), &again, 1, pixels.data());
  for (std::size_t i = 0; i < pixels.size(); ++i) ASSERT_EQ(pixels[i].color, colors[i]) << i;
}

// Every register that the table of signals describes, whenever its stage holds a pixel.
void compare_registers(const DatapathConfiguration& configuration, const RtlLibrary& library) {
  constexpr unsigned kSeed = 31;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  SpanSource source(configuration, kSeed);
  std::mt19937 random(kSeed);
  RtlDatapath rtl(library, kCueColor);
  DatapathRegisters systemc(configuration, kCueColor);
  const RtlSignals inside(rtl);
  const std::vector<DatapathSignal> signals = datapath_signals(configuration);
  std::vector<RtlRegister> registers;
  for (const DatapathSignal& signal : signals) {
    const auto found = RtlRegister::find(inside, signal);
    ASSERT_TRUE(found.has_value()) << signal.full_name();
    registers.push_back(*found);
  }
  std::vector<std::uint64_t> compared(signals.size());
  rtl.before_edge([&] {
    for (std::size_t i = 0; i < signals.size(); ++i) {
      if (!signals[i].counts(systemc)) continue;
      ++compared[i];
      EXPECT_EQ(registers[i].value(), signals[i].value(systemc)) << signals[i].full_name();
    }
  });
  DatapathInputs inputs;
  inputs.table = &source.table();
  for (; inputs.rom_address < configuration.rom_words(); ++inputs.rom_address) {
    rtl.clock(inputs);
    systemc.clock(inputs);
  }
  inputs.table = nullptr;
  Span span;
  for (int clock = 0;
       clock < 3'000 * configuration.interval_cycles() && !testing::Test::HasFailure(); ++clock) {
    // A reset in mid-pixel leaves nothing behind, such as a carry.
    if (random() % 100 == 0) {
      rtl.reset();
      systemc.reset();
      inputs.span = nullptr;
    }
    if (inputs.span == nullptr && random() % 4 != 0) {
      span = source.next(12);
      inputs.span = &span;
    }
    inputs.pixel_ready = random() % 4 != 0;
    rtl.clock(inputs);  // looks at SystemC's registers as they stand before the edge
    if (systemc.clock(inputs).span_ready) inputs.span = nullptr;
  }
  for (std::size_t i = 0; i < signals.size(); ++i) {
    EXPECT_GT(compared[i], signals[i].meaning == Meaning::first_pixel ? 200U : 1'000U)
        << signals[i].full_name();
  }
}

TEST(PixelDatapathRegisters, AreThoseOfSystemCInEveryClock) {
  RtlBuildOptions options;
  options.build = RtlBuild::signals;
  options.destination = PHONGPIPE_RTL_CACHE;
  build_missing_rtl(configurations(), options);  // together, which is faster
  for (const DatapathConfiguration& configuration : configurations()) {
    SCOPED_TRACE(name_of(configuration));
    compare_registers(configuration, RtlLibrary(configuration, options));
  }
}

// What SystemVerilog assigns in a clocked block: names on the left of <=.
std::set<std::string> registers_of(const std::filesystem::path& sources) {
  std::set<std::string> names;
  const std::regex assignment(R"((\{[\w, ]+\}|\w+)(\[[^\]]*\])*\s*<=)"), word(R"(\w+)");
  for (const auto& entry : std::filesystem::directory_iterator(sources)) {
    if (entry.path().extension() != ".sv") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      line.resize(std::min(line.size(), line.find("//")));
      std::smatch match;
      if (!std::regex_search(line, match, assignment)) continue;
      const std::string left = match[1];
      for (std::sregex_iterator i(left.begin(), left.end(), word), end; i != end; ++i) {
        names.insert(i->str());
      }
    }
  }
  return names;
}

// A register that the table of signals forgets would be named late when it fails, and would be no
// word with its weights in traces.
TEST(PixelDatapathRegisters, AreAllInTheTableOfSignals) {
  const std::set<std::string> left_out = {
      // Memories, and what they give to the output; both are compared there.
      "places", "colors", "pixel_valid", "pixel_place", "pixel_color", "table_words",
      "table_increments",
      // Of the table's write port; words are compared in the table.
      "new_word", "new_place", "new_increment_place", "write_bank", "write_base", "write_increment",
      // Described under the names of wires: s1_last_term, s1_y and the like; s3_v; s8_words and
      // s8_increments.
      "value", "digits", "s8_word", "s8_increment"};
  const std::set<std::string> registers = registers_of(installation().hardware);
  EXPECT_GT(registers.size(), 100U);
  std::set<std::string> described;
  for (const DatapathConfiguration& configuration : configurations()) {
    for (const DatapathSignal& signal : datapath_signals(configuration)) {
      described.insert(signal.packed.empty() ? signal.name : signal.packed);
    }
  }
  for (const std::string& name : registers) {
    EXPECT_EQ(described.count(name) + left_out.count(name), 1U) << name;
  }
  for (const std::string& name : left_out) EXPECT_EQ(registers.count(name), 1U) << name;
}

INSTANTIATE_TEST_SUITE_P(Configurations, PixelDatapathRtl, ::testing::ValuesIn(configurations()),
                         [](const auto& parameter) { return name_of(parameter.param); });

}  // namespace
}  // namespace phongpipe
