// pixel_datapath: stepping through the blocks is the definition; the closed forms, many pixels at a
// time, must give the same bits whatever the registers hold.
#include "model/fixed/pixel_datapath.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "testbench/tests/fixed/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kSeed = 37;
constexpr std::uint32_t kUntouched = 0xdeadbeef;

std::string text(const DatapathConfiguration& c) {
  return "channels " + std::to_string(c.channels) + ", diffuse " +
         std::to_string(c.diffuse_fraction_bits) + ", specular " +
         std::to_string(c.specular_fraction_bits) + ", rom " + std::to_string(c.rom_address_bits) +
         " x " + std::to_string(c.rom_data_bits) + ", gate " +
         std::to_string(static_cast<int>(c.gate));
}

DatapathConfiguration random_configuration(Random& random) {
  DatapathConfiguration c;
  const auto in_range_or_at_an_end = [&random](int low, int high) {
    const int choice = random.integer(0, 5);
    return choice == 0 ? low : choice == 1 ? high : random.integer(low, high);
  };
  c.channels = random.integer(0, 1) == 0 ? 1 : 3;
  c.diffuse_fraction_bits = in_range_or_at_an_end(kMinDiffuseFraction, kMaxDiffuseFraction);
  c.specular_fraction_bits = in_range_or_at_an_end(kMinSpecularFraction, kMaxSpecularFraction);
  c.rom_address_bits = in_range_or_at_an_end(kMinRomAddressBits, kMaxRomAddressBits);
  c.rom_data_bits = in_range_or_at_an_end(kMinRomDataBits, kMaxRomDataBits);
  c.gate = static_cast<GateSource>(random.integer(0, 2));
  return c;
}

MaterialSetup random_material(Random& random, const DatapathConfiguration& c) {
  MaterialSetup material = {};
  for (int channel = 0; channel < c.channels; ++channel) {
    const double ambient = random.uniform(0, 255);
    material.level[static_cast<std::size_t>(channel)] =
        std::llround(std::ldexp(ambient + 0.5, c.diffuse_fraction_bits));
    material.roms.emplace_back(c, random.uniform(0, 1.5), random.uniform(0, 200));
  }
  return material;
}

// From crawling to all over the register, extremes included; bits beyond the width are rubbish.
SeriesStart random_start(Random& random, int width) {
  const auto value = [&](int smallest_shift) {
    switch (random.integer(0, 9)) {
      case 0:
        return std::int64_t{1} << (width - 1);  // the most negative
      case 1:
        return (std::int64_t{1} << (width - 1)) - 1;  // the most positive
      default:
        return random.bits() >> random.integer(smallest_shift, 63);
    }
  };
  return {value(0), value(64 - width), value(64 - width)};
}

Span random_span(Random& random, const DatapathConfiguration& c, int length) {
  Span span;
  span.row = {random.integer(0, 4096 - length), random.integer(0, 4095), length};
  for (SeriesStart& start : span.diffuse) start = random_start(random, c.diffuse_width());
  span.gate = random_start(random, c.diffuse_width());
  span.specular = random_start(random, c.specular_width());
  return span;
}

std::vector<std::uint32_t> shade(const PixelDatapath& datapath, const Span& span) {
  std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length) + 1, kUntouched);
  datapath.shade(span, colors.data());
  EXPECT_EQ(colors.back(), kUntouched) << "written beyond the padded length";
  colors.resize(static_cast<std::size_t>(span.row.length));
  return colors;
}

void expect_same(Random& random, const DatapathConfiguration& c, Evaluation evaluation,
                 int longest) {
  PixelDatapath stepping(c, Evaluation::stepping), closed_form(c, evaluation);
  const MaterialSetup material = random_material(random, c);
  stepping.load_material(material);
  closed_form.load_material(material);
  for (int i = 0; i < 12; ++i) {
    const int length = i == 0 ? 1 : i == 1 ? longest : random.integer(1, longest);
    const Span span = random_span(random, c, length);
    const std::vector<std::uint32_t> expected = shade(stepping, span);
    const std::vector<std::uint32_t> colors = shade(closed_form, span);
    for (std::size_t k = 0; k < colors.size(); ++k) {
      ASSERT_EQ(colors[k], expected[k])
          << "pixel " << k << " of " << length << "; " << text(c) << "; specular v "
          << span.specular.v << " d1 " << span.specular.d1 << " d2 " << span.specular.d2;
    }
  }
}

void expect_stepping(Evaluation evaluation) {
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (int i = 0; i < 600; ++i) {
    expect_same(random, random_configuration(random), evaluation, i % 20 == 0 ? 4096 : 100);
    if (testing::Test::HasFatalFailure()) FAIL() << "configuration " << i;
  }
}

TEST(PixelDatapath, PortableEqualsStepping) {
  expect_stepping(Evaluation::portable);
}

TEST(PixelDatapath, TheBestEvaluationEqualsStepping) {
  expect_stepping(best_evaluation());
}

TEST(PixelDatapath, EveryGateAndChannelCountInBothWordSizes) {
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  for (const int channels : {1, 3}) {
    for (const GateSource gate : {GateSource::off, GateSource::diffuse, GateSource::series}) {
      for (const int diffuse_fraction : {4, 22, 23, 30}) {  // 32 bits are 22 of them
        for (const int specular_fraction : {1, 20, 21, 25}) {
          DatapathConfiguration c;
          c.channels = channels;
          c.gate = gate;
          c.diffuse_fraction_bits = diffuse_fraction;
          c.specular_fraction_bits = specular_fraction;
          for (const Evaluation evaluation : {Evaluation::portable, best_evaluation()}) {
            expect_same(random, c, evaluation, 64);
          }
        }
      }
    }
  }
}

// By hand, so that all evaluations cannot be wrong together.
class Pixel : public testing::TestWithParam<Evaluation> {
 protected:
  // A pixel of constant diffuse light and highlight: `diffuse` in LSB with ambient light and half.
  std::uint32_t color(GateSource gate, double diffuse, double specular, double gate_value) {
    DatapathConfiguration c;
    c.gate = gate;
    MaterialSetup material = {};
    material.level[0] = std::llround(20.5 * 65536);
    material.roms.emplace_back(c, 0.5, 1);  // 127.5 at full scale
    PixelDatapath datapath(c, GetParam());
    datapath.load_material(material);
    Span span;
    span.row = {0, 0, 1};
    span.diffuse[0].v = std::llround(diffuse * 65536);
    span.specular.v = std::llround(specular * (1024 << 12));
    span.gate.v = std::llround(gate_value * 65536);
    return shade(datapath, span)[0];
  }
};

TEST_P(Pixel, AddsHighlightToDiffuseLight) {
  EXPECT_EQ(color(GateSource::diffuse, 100.5, 0.5, 0), 100U + 64U);
  EXPECT_EQ(color(GateSource::diffuse, 100.5, -0.1, 0), 100U);
  EXPECT_EQ(color(GateSource::diffuse, 100.5, 1.2, 0), 100U + 127U) << "the address saturates";
  EXPECT_EQ(color(GateSource::diffuse, 200.5, 1, 0), 255U) << "the sum saturates";
}

TEST_P(Pixel, IsAmbientAndWithoutHighlightWhereUnlit) {
  EXPECT_EQ(color(GateSource::diffuse, -50, 1, 0), 20U);
  EXPECT_EQ(color(GateSource::diffuse, 20.5, 1, 0), 20U) << "N·L = 0";
  EXPECT_EQ(color(GateSource::diffuse, 20.5 + 1 / 65536.0, 1, 0), 20U + 127U);
}

TEST_P(Pixel, TheGateSeriesDecidesInPlaceOfTheDiffuse) {
  EXPECT_EQ(color(GateSource::series, -50, 1, 1), 20U + 127U);
  EXPECT_EQ(color(GateSource::series, 100.5, 1, 0), 100U);
  EXPECT_EQ(color(GateSource::series, 100.5, 1, -1), 100U);
  EXPECT_EQ(color(GateSource::off, -50, 1, -1), 20U + 127U) << "the paper's form";
}

INSTANTIATE_TEST_SUITE_P(PixelDatapath, Pixel,
                         testing::Values(Evaluation::stepping, Evaluation::portable,
                                         best_evaluation()));

// One lit channel is enough for the highlight of all.
TEST(PixelDatapath, AnyLitChannelOpensTheHighlight) {
  DatapathConfiguration c;
  c.channels = 3;
  MaterialSetup material = {};
  for (std::size_t i = 0; i < 3; ++i) {
    material.level[i] = 65536 / 2;
    material.roms.emplace_back(c, 0.5, 0);  // 128, by 8 bits
  }
  for (const Evaluation evaluation :
       {Evaluation::stepping, Evaluation::portable, best_evaluation()}) {
    PixelDatapath datapath(c, evaluation);
    datapath.load_material(material);
    Span span;
    span.row = {0, 0, 1};
    for (SeriesStart& start : span.diffuse) start.v = 0;
    EXPECT_EQ(shade(datapath, span)[0], 0U);
    span.diffuse[2].v = 10 * 65536 + 65536 / 2;
    EXPECT_EQ(shade(datapath, span)[0], 0x8a8080U);
  }
}

}  // namespace
}  // namespace phongpipe
