// pixel_datapath: stepping through the blocks is the definition; the closed forms, many pixels at a
// time, must give the same bits whatever the registers hold.
#include "model/fixed/pixel_datapath.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "testbench/cases/random_datapath.h"

namespace phongpipe {
namespace {

constexpr unsigned kPixelDatapathSeed = 37;
constexpr std::uint32_t kUntouched = 0xdeadbeef;

std::vector<std::uint32_t> shade(const PixelDatapath& datapath, const Span& span) {
  std::vector<std::uint32_t> colors(PixelDatapath::padded(span.row.length) + 1, kUntouched);
  datapath.shade(span, colors.data());
  EXPECT_EQ(colors.back(), kUntouched) << "written beyond the padded length";
  colors.resize(static_cast<std::size_t>(span.row.length));
  return colors;
}

void expect_same(Random& random, const DatapathConfiguration& c, Evaluation evaluation,
                 int longest) {
  const OutputColor cue_color = random_color(random);
  PixelDatapath stepping(c, Evaluation::stepping, cue_color), closed_form(c, evaluation, cue_color);
  const HighlightTable table = random_table(random, c);
  stepping.load_table(table);
  closed_form.load_table(table);
  for (int i = 0; i < 12; ++i) {
    const int length = i == 0 ? 1 : i == 1 ? longest : random.integer(1, longest);
    const Span span = random_span(random, c, length);
    const std::vector<std::uint32_t> expected = shade(stepping, span);
    const std::vector<std::uint32_t> colors = shade(closed_form, span);
    for (std::size_t k = 0; k < colors.size(); ++k) {
      ASSERT_EQ(colors[k], expected[k])
          << "pixel " << k << " of " << length << "; " << text(c) << "; specular v "
          << span.specular.v << " d1 " << span.specular.d1 << " d2 " << span.specular.d2
          << "; first_pass " << span.first_pass << ", highlight " << span.highlight;
    }
  }
}

void expect_stepping(Evaluation evaluation) {
  SCOPED_TRACE(kPixelDatapathSeed);
  Random random(kPixelDatapathSeed);
  for (int i = 0; i < 600; ++i) {
    expect_same(random, random_configuration(random), evaluation, i % 20 == 0 ? 4096 : 100);
    if (testing::Test::HasFatalFailure()) FAIL() << "configuration " << i;
  }
}

// Back to back, whatever the lengths, with and without highlights.
void expect_batch_is_its_spans(Evaluation evaluation) {
  SCOPED_TRACE(kPixelDatapathSeed);
  Random random(kPixelDatapathSeed);
  for (int i = 0; i < 100; ++i) {
    const DatapathConfiguration c = random_configuration(random);
    PixelDatapath datapath(c, evaluation, random_color(random));
    datapath.load_table(random_table(random, c));
    std::vector<Span> spans;
    std::vector<std::uint32_t> expected;
    std::size_t room = 0;
    for (int k = random.integer(0, 20); k > 0; --k) {
      spans.push_back(random_span(random, c, random.integer(1, 20)));
      const std::vector<std::uint32_t> colors = shade(datapath, spans.back());
      room = expected.size() + PixelDatapath::padded(spans.back().row.length);
      expected.insert(expected.end(), colors.begin(), colors.end());
    }
    std::vector<std::uint32_t> colors(room + 1, kUntouched);
    datapath.shade(spans.data(), spans.size(), colors.data());
    EXPECT_EQ(colors.back(), kUntouched) << "written beyond the room of the last span";
    colors.resize(expected.size());
    ASSERT_EQ(colors, expected) << spans.size() << " spans; " << text(c);
  }
}

TEST(PixelDatapath, SpansTogetherAreThoseOneByOne) {
  for (const Evaluation evaluation :
       {Evaluation::stepping, Evaluation::portable, best_evaluation()}) {
    expect_batch_is_its_spans(evaluation);
  }
}

TEST(PixelDatapath, PortableEqualsStepping) {
  expect_stepping(Evaluation::portable);
}

TEST(PixelDatapath, TheBestEvaluationEqualsStepping) {
  expect_stepping(best_evaluation());
}

// The same with the seed left to chance; rapidcheck prints what replays a failure.
RC_GTEST_PROP(PixelDatapath, AllEvaluationsAgreeForAnyBlocksAndFlags, ()) {
  Random random(*rc::gen::noShrink(rc::gen::arbitrary<unsigned>()));
  const DatapathConfiguration c = random_configuration(random);
  RC_TAG(std::string(c.diffuse ? "diffuse " : "") + (c.specular ? "specular " : "") +
         (c.depth_cue ? "depth cueing" : ""));
  for (const Evaluation evaluation : {Evaluation::portable, best_evaluation()}) {
    expect_same(random, c, evaluation, 64);
    RC_ASSERT(!testing::Test::HasFailure());
  }
}

// What is left out counts as if it gave nothing.
TEST(PixelDatapath, EveryCombinationOfBlocksInBothWordSizes) {
  SCOPED_TRACE(kPixelDatapathSeed);
  Random random(kPixelDatapathSeed);
  for (int blocks = 0; blocks < 8; ++blocks) {
    for (const GateSource gate : {GateSource::off, GateSource::diffuse, GateSource::series}) {
      for (const int channels : {1, 3}) {
        for (const int fraction : {16, 30}) {
          DatapathConfiguration c;
          c.diffuse = (blocks & 1) != 0;
          c.specular = (blocks & 2) != 0;
          c.depth_cue = (blocks & 4) != 0;
          if (c.specular && !c.diffuse && gate == GateSource::diffuse) continue;  // illegal
          c.gate = gate;
          c.channels = channels;
          c.diffuse_fraction_bits = fraction;
          for (const Evaluation evaluation : {Evaluation::portable, best_evaluation()}) {
            expect_same(random, c, evaluation, 64);
          }
        }
      }
    }
  }
}

TEST(PixelDatapath, EveryGateAndChannelCountInBothWordSizes) {
  SCOPED_TRACE(kPixelDatapathSeed);
  Random random(kPixelDatapathSeed);
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
    HighlightTable table;
    table.roms.emplace_back(c, 0.5, 1);  // 127.5 at full scale
    PixelDatapath datapath(c, GetParam());
    datapath.load_table(table);
    Span span;
    span.row = {0, 0, 1};
    span.level[0] = std::llround(20.5 * 65536);
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

// 20.5 LSB of level, 100.5 of diffuse light, 64 of highlight; the cue's colour is 40.
class CuedPixel : public testing::TestWithParam<Evaluation> {
 protected:
  std::uint32_t color(double cue_factor, bool first_pass, bool highlight = true,
                      double diffuse = 100.5) {
    DatapathConfiguration c;
    c.depth_cue = true;
    HighlightTable table;
    table.roms.emplace_back(c, 0.5, 1);
    PixelDatapath datapath(c, GetParam(), {40, 0, 0});
    datapath.load_table(table);
    Span span;
    span.row = {0, 0, 1};
    span.first_pass = first_pass;
    span.highlight = highlight;
    span.level[0] = std::llround(20.5 * 65536);
    span.diffuse[0].v = std::llround(diffuse * 65536);
    span.specular.v = 512 << 12;
    span.cue.v = std::llround(std::ldexp(cue_factor, kCueFraction));
    return shade(datapath, span)[0];
  }
};

TEST_P(CuedPixel, FadesToTheCuesColor) {
  EXPECT_EQ(color(1, true), 164U);
  EXPECT_EQ(color(3, true), 164U) << "nearer than near";
  EXPECT_EQ(color(0.5, true), 102U);
  EXPECT_EQ(color(0, true), 40U);
  EXPECT_EQ(color(-2, true), 40U) << "farther than far";
  EXPECT_EQ(color(0.5, true, true, 400.5), 252U) << "of the unclamped 464";
}

TEST_P(CuedPixel, OfAFurtherLightFadesToNothing) {
  EXPECT_EQ(color(1, false), 164U);
  EXPECT_EQ(color(0.5, false), 82U);
  EXPECT_EQ(color(0, false), 0U);
}

TEST_P(CuedPixel, NeedsNoHighlight) {
  EXPECT_EQ(color(1, true, false), 100U);
  EXPECT_EQ(color(0.5, true, false), 70U);
}

INSTANTIATE_TEST_SUITE_P(PixelDatapath, CuedPixel,
                         testing::Values(Evaluation::stepping, Evaluation::portable,
                                         best_evaluation()));

INSTANTIATE_TEST_SUITE_P(PixelDatapath, Pixel,
                         testing::Values(Evaluation::stepping, Evaluation::portable,
                                         best_evaluation()));

// One lit channel is enough for the highlight of all.
TEST(PixelDatapath, AnyLitChannelOpensTheHighlight) {
  DatapathConfiguration c;
  c.channels = 3;
  HighlightTable table;
  for (int i = 0; i < 3; ++i) table.roms.emplace_back(c, 0.5, 0);  // 128, by 8 bits
  for (const Evaluation evaluation :
       {Evaluation::stepping, Evaluation::portable, best_evaluation()}) {
    PixelDatapath datapath(c, evaluation);
    datapath.load_table(table);
    Span span;
    span.row = {0, 0, 1};
    span.level.fill(65536 / 2);
    for (SeriesStart& start : span.diffuse) start.v = 0;
    EXPECT_EQ(shade(datapath, span)[0], 0U);
    span.diffuse[2].v = 10 * 65536 + 65536 / 2;
    EXPECT_EQ(shade(datapath, span)[0], 0x8a8080U);
  }
}

}  // namespace
}  // namespace phongpipe
