// RTL pixel_datapath ≡ model, for values, and ≡ SystemC's pipeline, for every clock of its ports.
#include "model/fixed/pixel_datapath.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "sim/datapath_pipeline.h"
#include "testbench/rtl/rtl_library.h"

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

// The presets, and the corners of every parameter.
std::vector<DatapathConfiguration> configurations() {
  return {configured(1, 16, 12, 10, 8, GateSource::diffuse),
          configured(3, 16, 12, 10, 8, GateSource::diffuse),
          configured(1, 16, 12, 13, 8, GateSource::diffuse),
          configured(1, 4, 1, 6, 4, GateSource::off),
          configured(3, 4, 25, 13, 12, GateSource::series),
          configured(1, 30, 25, 13, 12, GateSource::series),
          configured(3, 30, 1, 6, 9, GateSource::off)};
}

std::string name_of(const DatapathConfiguration& c) {
  return fmt::format("c{}_d{}_s{}_a{}_w{}_g{}", c.channels, c.diffuse_fraction_bits,
                     c.specular_fraction_bits, c.rom_address_bits, c.rom_data_bits,
                     static_cast<int>(c.gate));
}

class SpanSource {
 public:
  SpanSource(const DatapathConfiguration& configuration, unsigned seed)
      : configuration_(configuration), random_(seed) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(configuration.channels); ++c) {
      const std::int64_t scale = std::int64_t{1} << configuration.diffuse_fraction_bits;
      material_.level[c] = (static_cast<std::int64_t>(random_()) & 0x7f) * scale + scale / 2;
      material_.roms.emplace_back(configuration, 0.9 - 0.2 * static_cast<double>(c), 8);
    }
  }
  const MaterialSetup& material() const { return material_; }

  Span next(int longest) {
    Span span;
    span.row = {static_cast<int>(random_() % 1000), static_cast<int>(random_() % 4096),
                1 + static_cast<int>(random_() % static_cast<unsigned>(longest))};
    for (SeriesStart& series : span.diffuse) series = start(configuration_.diffuse_width());
    span.specular = start(configuration_.specular_width());
    span.gate = start(configuration_.diffuse_width());
    return span;
  }

 private:
  // The ends of the format, values beside zero, slow slopes, and anything.
  std::int64_t value(int width) {
    const std::int64_t top = (std::int64_t{1} << (width - 1)) - 1;
    const auto any = static_cast<std::int64_t>(random_());
    switch (random_() % 6) {
      case 0:
        return top;
      case 1:
        return -top - 1;
      case 2:
        return any % 3;
      case 3:
        return any % (top / 256 + 1);
      default:
        return wrap_to(any, width);
    }
  }
  SeriesStart start(int width) { return {value(width), value(width), value(width)}; }

  DatapathConfiguration configuration_;
  std::mt19937_64 random_;
  MaterialSetup material_;
};

class PixelDatapathRtl : public ::testing::TestWithParam<DatapathConfiguration> {
 protected:
  PixelDatapathRtl() : library_(GetParam(), build_options()) {}
  RtlLibrary library_;
};

TEST_P(PixelDatapathRtl, ValuesEqualTheModelOnRandomSpans) {
  constexpr unsigned kSeed = 22;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  SpanSource source(GetParam(), kSeed);
  RtlDatapath rtl(library_);
  rtl.load_material(source.material());
  PixelDatapath model(GetParam(), Evaluation::stepping);
  model.load_material(source.material());

  std::vector<RtlSpan> spans;
  std::vector<ShadedPixel> expected;
  for (int s = 0; s < 2000; ++s) {
    const Span span = source.next(s % 100 == 0 ? 3000 : 40);
    spans.push_back(to_rtl(span, source.material()));
    std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length));
    model.shade(span, colors.data());
    for (int i = 0; i < span.row.length; ++i) {
      expected.push_back({static_cast<std::uint16_t>((span.row.x + i) & 0xfff),
                          static_cast<std::uint16_t>(span.row.y),
                          colors[static_cast<std::size_t>(i)]});
    }
  }
  std::vector<RtlPixel> pixels(expected.size());
  const std::uint64_t clocks =
      library_.interface().run(rtl.rtl(), spans.data(), spans.size(), pixels.data());
  // One pixel a clock, no bubbles between spans, and the latency once.
  EXPECT_EQ(clocks, expected.size() + kDatapathLatency);
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
  RtlDatapath rtl(library_);
  DatapathPipeline systemc(GetParam());
  DatapathInputs inputs;
  inputs.material = &source.material();
  inputs.rom_write = true;
  for (; inputs.rom_address < GetParam().rom_words(); ++inputs.rom_address) {
    rtl.clock(inputs);
    systemc.clock(inputs);
  }
  inputs.rom_write = false;

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
      ASSERT_EQ(actual.pixel.color, expected.pixel.color) << "clock " << clock;
      ASSERT_EQ(actual.pixel.x, expected.pixel.x) << "clock " << clock;
      ASSERT_EQ(actual.pixel.y, expected.pixel.y) << "clock " << clock;
      pixels += inputs.pixel_ready;
    }
    if (expected.span_ready) inputs.span = nullptr;
  }
  EXPECT_GT(pixels, 10'000U);  // or nothing was compared
}

TEST_P(PixelDatapathRtl, FirstPixelTakesExactlyTheLatency) {
  SpanSource source(GetParam(), 24);
  RtlDatapath rtl(library_);
  const Span span = source.next(1);
  DatapathInputs inputs;
  inputs.material = &source.material();
  inputs.span = &span;
  inputs.pixel_ready = true;
  ASSERT_TRUE(rtl.clock(inputs).span_ready);
  inputs.span = nullptr;
  for (int clock = 1; clock < kDatapathLatency; ++clock) {
    EXPECT_FALSE(rtl.clock(inputs).pixel_valid) << "clock " << clock;
  }
  EXPECT_TRUE(rtl.clock(inputs).pixel_valid);
  EXPECT_FALSE(rtl.clock(inputs).pixel_valid);
}

TEST_P(PixelDatapathRtl, ResetDropsPixelsInFlightAndKeepsTheTable) {
  SpanSource source(GetParam(), 25);
  RtlDatapath rtl(library_);
  rtl.load_material(source.material());
  DatapathInputs inputs;
  inputs.material = &source.material();
  const Span span = source.next(40);
  inputs.span = &span;
  rtl.clock(inputs);
  rtl.reset();
  inputs.span = nullptr;
  inputs.pixel_ready = true;
  for (int clock = 0; clock < 60; ++clock) ASSERT_FALSE(rtl.clock(inputs).pixel_valid);

  PixelDatapath model(GetParam(), Evaluation::stepping);
  model.load_material(source.material());
  std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length));
  model.shade(span, colors.data());
  std::vector<RtlPixel> pixels(static_cast<std::size_t>(span.row.length));
  const RtlSpan again = to_rtl(span, source.material());
  library_.interface().run(rtl.rtl(), &again, 1, pixels.data());
  for (std::size_t i = 0; i < pixels.size(); ++i) ASSERT_EQ(pixels[i].color, colors[i]) << i;
}

INSTANTIATE_TEST_SUITE_P(Configurations, PixelDatapathRtl, ::testing::ValuesIn(configurations()),
                         [](const auto& parameter) { return name_of(parameter.param); });

}  // namespace
}  // namespace phongpipe
