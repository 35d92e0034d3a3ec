// Bounds that are proved: no measured error exceeds one, and somewhere each is nearly reached.
#include <gtest/gtest.h>

#include "model/fixed/front_end.h"
#include "model/fixed/register_ranges.h"
#include "model/fixed/rounding_bound.h"
#include "testbench/cases/random_effects.h"

namespace phongpipe {
namespace {

constexpr unsigned kBoundsSeed = 8;
constexpr int kFraction = 8;  // bits of the registers

// The largest difference of a stepped series from its unrounded coefficients, in units, over one
// span. `worst`: all coefficients are just below half a unit of setup off, to the same side.
double measured_drift(Random& random, const FixedPointFormats& formats, int extent, int length,
                      bool worst) {
  const int setup_bits = setup_fraction_bits(formats, kFraction);
  const double unit = std::ldexp(1, setup_bits - kFraction);  // of the registers, in setup's
  bool overflow = false;
  std::array<double, 6> exact;
  std::array<std::int64_t, 6> rounded;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double off = worst ? 0.499 : random.uniform(-0.5, 0.5);
    const double whole = std::floor(random.uniform(-1000, 1000) * unit);
    exact[i] = std::ldexp(whole + off, -setup_bits);
    rounded[i] = to_fixed(exact[i], setup_bits, overflow);
  }
  const FixedQuadratic t{rounded[0], rounded[1], rounded[2], rounded[3], rounded[4], rounded[5]};
  const auto real = [&](int x, int y) {
    return exact[0] + exact[1] * y + exact[2] * x + exact[3] * y * y + exact[4] * x * y +
           exact[5] * x * x;
  };
  const int y = worst ? extent : random.integer(-extent, extent);
  const int x = worst ? extent - length + 1 : random.integer(-extent, extent - length + 1);
  const int dropped = setup_bits - kFraction;
  ForwardDifferencer series(60);
  series.load({round_off(t.value(x, y), dropped), round_off(t.difference(x, y), dropped),
               round_off(2 * t.t5, dropped)});
  double largest = 0;
  for (int i = 0; i < length; ++i) {
    const double stepped = std::ldexp(static_cast<double>(series.v()), -kFraction);
    largest = std::max(largest, std::fabs(stepped - real(x + i, y)));
    series.step();
  }
  EXPECT_FALSE(overflow);
  return largest;
}

TEST(RoundingBound, HoldsForRandomSeriesAndIsNearlyReached) {
  SCOPED_TRACE(kBoundsSeed);
  Random random(kBoundsSeed);
  for (const Anchor anchor : {Anchor::triangle, Anchor::span}) {
    FixedPointFormats formats;
    formats.anchor = anchor;
    for (const int extent : {4, 40, 400}) {
      double nearest = 0;
      for (int i = 0; i < 3000; ++i) {
        const int length = random.integer(1, extent);
        const double bound = rounding_bound(formats, kFraction, extent, length);
        const double drift = measured_drift(random, formats, extent, length, i % 2 == 0);
        ASSERT_LE(drift, bound) << "extent " << extent << ", length " << length;
        nearest = std::max(nearest, drift / bound);
      }
      EXPECT_GE(nearest, 0.5) << "extent " << extent;
    }
  }
}

TEST(RoundingBound, FewestBitsAreEnoughAndOneLessIsNot) {
  for (const Anchor anchor : {Anchor::triangle, Anchor::span}) {
    FixedPointFormats formats;
    formats.anchor = anchor;
    for (const int length : {8, 64, 1024, 4096}) {
      for (const double tolerance : {0.25, 0.01}) {
        const auto bits = fewest_fraction_bits(formats, length, length, tolerance, 60);
        ASSERT_TRUE(bits.has_value());
        EXPECT_LE(rounding_bound(formats, *bits, length, length), tolerance);
        EXPECT_GT(rounding_bound(formats, *bits - 1, length, length), tolerance);
        EXPECT_FALSE(fewest_fraction_bits(formats, length, length, tolerance, *bits - 1));
      }
    }
  }
}

// Over all layouts, sizes and exponents, at both ends of every address.
TEST(TableErrorBound, HoldsForEveryWordAndIsNearlyReached) {
  DatapathConfiguration c;
  for (const RomLayout layout : {RomLayout::plain, RomLayout::octave, RomLayout::bipartite}) {
    c.rom_layout = layout;
    double nearest = 0;
    for (const int address_bits : {6, 9, 13}) {
      for (const int data_bits : {4, 8, 12}) {
        for (const auto& [specular, n] : {std::pair{0.8, 0.0},
                                          {0.8, 0.5},
                                          {0.8, 1.0},
                                          {1.0, 1.0},
                                          {0.8, 20.0},
                                          {1.0, 20.0},
                                          {0.8, 164.0},
                                          {0.8, 10'000.0}}) {
          c.rom_address_bits = address_bits;
          c.rom_data_bits = data_bits;
          const ExponentRom rom(c, specular, n);
          const double bound = table_error_bound(c, specular, n), reach = highlight_reach(c, n);
          double error = 0;
          for (int address = 0; address < c.rom_addresses(); ++address) {
            const double word =
                std::ldexp(rom.words()[static_cast<std::size_t>(address)], kOutputBits - data_bits);
            for (const int end : {0, 1}) {
              const double u = static_cast<double>(address + end) / c.rom_addresses();
              const double x = std::max(0.0, 1 - reach * (1 - u));
              error = std::max(error, std::fabs(word - kOutputMax * specular * std::pow(x, n)));
            }
          }
          ASSERT_LE(error, bound + 1e-9) << address_bits << " " << data_bits << " " << n;
          nearest = std::max(nearest, error / bound);
        }
      }
    }
    EXPECT_GE(nearest, 0.9) << static_cast<int>(layout);
  }
}

// The ends of the ranges are values of some pixel: the ranges are those of stepping, exactly.
TEST(RegisterRanges, AreThoseOfSteppingEveryPixel) {
  SCOPED_TRACE(kBoundsSeed);
  for (unsigned seed = kBoundsSeed; seed < kBoundsSeed + 20; ++seed) {
    Random random(seed);
    const auto [scene, geometry, configuration] = random_effects(random);
    const FrameSetup frame(scene, geometry, with_derived_blocks(configuration, scene, geometry));
    RegisterRange v, d1;
    const FrontEnd front_end(frame);
    TriangleWork work;
    for (TriangleOrder next(front_end); !next.done(); next.advance()) {
      if (front_end.set_up(next.triangle(), next.pass(), work) != SetupOutcome::ready) continue;
      for (const RowSpan& row : work.rows) {
        const Span span = front_end.span_walker().start(work.setup, row);
        ForwardDifferencer series(62);
        series.load(span.specular);
        for (int i = 0; i < row.length; ++i, series.step()) {
          v.include(static_cast<double>(series.v()));
          d1.include(static_cast<double>(series.d1()));
        }
      }
    }
    for (const SeriesRanges& ranges : register_ranges(frame)) {
      EXPECT_TRUE(ranges.fits()) << ranges.name;
      if (ranges.name != "specular") continue;
      EXPECT_EQ(ranges.v.low, v.low);
      EXPECT_EQ(ranges.v.high, v.high);
      EXPECT_EQ(ranges.d1.low, d1.low);
      EXPECT_EQ(ranges.d1.high, d1.high);
    }
  }
}

TEST(RegisterRanges, WidthIsTheFewestBits) {
  RegisterRange range;
  EXPECT_EQ(range.width(), 1);
  range.include(-1);
  EXPECT_EQ(range.width(), 1);
  range.include(1);
  EXPECT_EQ(range.width(), 2);
  range.include(-128);
  EXPECT_EQ(range.width(), 8);
  range.include(128);
  EXPECT_EQ(range.width(), 9);
}

}  // namespace
}  // namespace phongpipe
