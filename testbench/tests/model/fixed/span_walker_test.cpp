// span_walker: starts of spans are exact, and a span whose values leave their register is reported.
#include "model/fixed/span_walker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/fixed/front_end.h"
#include "testbench/cases/random_effects.h"

namespace phongpipe {
namespace {

__extension__ using Wide = __int128;

constexpr unsigned kSpanWalkerSeed = 31;

Wide exact_value(const FixedQuadratic& t, int x, int y) {
  return Wide{t.t5} * x * x + Wide{t.t4} * x * y + Wide{t.t3} * y * y + Wide{t.t2} * x +
         Wide{t.t1} * y + t.t0;
}
// To nearest, ties up.
Wide rounded(Wide value, int bits) {
  return bits == 0 ? value : (value + (Wide{1} << (bits - 1))) >> bits;
}

FrameSetup frame_of(const FrameConfiguration& configuration) {
  return FrameSetup(lit_scene(4096, 4096), Geometry(), configuration);
}

struct Starts {
  Wide v, d1, d2;
};
Starts exact_starts(const FixedQuadratic& t, int x, int y, int dropped) {
  return {rounded(exact_value(t, x, y), dropped),
          rounded(exact_value(t, x + 1, y) - exact_value(t, x, y), dropped),
          rounded(2 * Wide{t.t5}, dropped)};
}
void expect_starts(const SeriesStart& start, const Starts& exact) {
  EXPECT_EQ(start.v, static_cast<std::int64_t>(exact.v));
  EXPECT_EQ(start.d1, static_cast<std::int64_t>(exact.d1));
  EXPECT_EQ(start.d2, static_cast<std::int64_t>(exact.d2));
}

// Coefficients that take the series across about the register's range within the span.
FixedQuadratic random_series(Random& random, double range, int length) {
  const auto up_to = [&random](double limit) {
    return static_cast<std::int64_t>(random.uniform(-limit, limit));
  };
  const double n = length;
  return {up_to(range),         up_to(range / n),     up_to(range / n),
          up_to(range / n / n), up_to(range / n / n), up_to(range / n / n)};
}

TEST(SpanWalker, StartsAreExactFromTheRoundedCoefficients) {
  SCOPED_TRACE(kSpanWalkerSeed);
  Random random(kSpanWalkerSeed);
  for (const Anchor anchor : {Anchor::triangle, Anchor::span}) {
    FrameConfiguration configuration;
    configuration.channels = 3;
    configuration.gate = GateSource::series;
    configuration.depth_cue = true;
    configuration.anchor = anchor;
    const SpanWalker walker(frame_of(configuration));
    const int dropped = anchor == Anchor::span ? kSetupExtraBits : 0;
    MaterialSetup material = {};
    material.level = {11, 12, 13};
    material.table = 3;
    for (int i = 0; i < 500; ++i) {
      TriangleSetup setup;
      setup.x = random.integer(0, 4095);
      setup.y = random.integer(0, 4095);
      setup.triangle = 17;
      setup.pass = static_cast<std::uint32_t>(i % 2);
      setup.material = &material;
      setup.plan.gate = SeriesForm::fitted;
      setup.plan.depth_cue = true;
      const RowSpan row = {random.integer(0, 4000), random.integer(0, 4095), random.integer(1, 96)};
      for (FixedQuadratic& t : setup.diffuse) t = random_series(random, 0x1p44, 4096);
      setup.specular = random_series(random, 0x1p44, 4096);
      setup.gate = random_series(random, 0x1p44, 4096);
      const auto slope = [&random] { return random.integer(-(1 << 24), 1 << 24); };
      setup.depth = {random.integer(0, 1 << 30), slope(), slope()};
      setup.cue_factor = {random.integer(0, 1 << 30), slope(), slope()};
      const Span span = walker.start(setup, row);
      const int x = row.x - setup.x, y = row.y - setup.y;
      for (std::size_t c = 0; c < 3; ++c) {
        expect_starts(span.diffuse[c], exact_starts(setup.diffuse[c], x, y, dropped));
      }
      expect_starts(span.specular, exact_starts(setup.specular, x, y, dropped));
      expect_starts(span.gate, exact_starts(setup.gate, x, y, dropped));
      EXPECT_EQ(span.depth, setup.depth.c + setup.depth.a * x + setup.depth.b * y);
      EXPECT_EQ(span.depth_step, setup.depth.a);
      const auto& [share, share_x, share_y] = setup.cue_factor;
      expect_starts(span.cue,
                    {rounded(Wide{share} + Wide{share_x} * x + Wide{share_y} * y, dropped),
                     rounded(share_x, dropped), 0});
      EXPECT_EQ(span.row.x, row.x);
      EXPECT_EQ(span.row.y, row.y);
      EXPECT_EQ(span.row.length, row.length);
      EXPECT_EQ(span.triangle, 17U);
      EXPECT_EQ(span.first_pass, i % 2 == 0);
      EXPECT_EQ(span.table, 3U);
      EXPECT_EQ(span.level, material.level);
      if (HasFailure()) FAIL() << "case " << i << ", x " << x << ", y " << y;
    }
  }
}

// Largest and smallest value of a series at the pixels of a span, as its registers would have them
// were they wide enough.
std::array<Wide, 2> extremes(const Starts& start, int length) {
  Wide v = start.v, d1 = start.d1, low = v, high = v;
  for (int i = 1; i < length; ++i) {
    v += d1;
    d1 += start.d2;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return {low, high};
}

struct Formats {
  Anchor anchor;
  int diffuse_fraction, specular_fraction, longest;
};

// `margin`: the share of the register's range within which a flag is not yet asked for.
void expect_flags(const Formats& formats, double margin) {
  SCOPED_TRACE(kSpanWalkerSeed);
  Random random(kSpanWalkerSeed);
  FrameConfiguration configuration;
  configuration.anchor = formats.anchor;
  configuration.diffuse_fraction_bits = formats.diffuse_fraction;
  configuration.specular_fraction_bits = formats.specular_fraction;
  const SpanWalker walker(frame_of(configuration));
  const int dropped = formats.anchor == Anchor::span ? kSetupExtraBits : 0;
  int flagged = 0, fitting = 0;
  for (int i = 0; i < 4000; ++i) {
    const RowSpan row = {random.integer(0, 4096 - formats.longest), random.integer(0, 4095),
                         random.integer(1, formats.longest)};
    TriangleSetup setup;
    setup.x = row.x + random.integer(0, row.length - 1);
    setup.y = std::clamp(row.y + random.integer(-row.length, row.length), 0, 4095);
    const bool diffuse = i % 2 == 0;
    const int width = diffuse ? configuration.diffuse_width() : configuration.specular_width();
    const FixedQuadratic t =
        random_series(random, std::ldexp(random.uniform(0.1, 1), width + dropped - 1), row.length);
    (diffuse ? setup.diffuse[0] : setup.specular) = t;
    const bool overflow = !walker.fits(setup, row);
    const auto [low, high] =
        extremes(exact_starts(t, row.x - setup.x, row.y - setup.y, dropped), row.length);
    const Wide end = Wide{1} << (width - 1);
    const auto slack = static_cast<Wide>(std::ldexp(margin, width - 1));
    const auto show = [&] {
      return testing::Message() << "case " << i << ", width " << width << ", length " << row.length
                                << ": " << static_cast<double>(low) << " to "
                                << static_cast<double>(high);
    };
    if (low < -end || high >= end) {
      ASSERT_TRUE(overflow) << show() << " leaves the register unreported";
      ++flagged;
    } else if (low > -end + slack && high < end - slack) {
      ASSERT_FALSE(overflow) << show() << " is reported, though it fits";
      ++fitting;
    }
  }
  EXPECT_GT(flagged, 300);
  EXPECT_GT(fitting, 300);
}

TEST(SpanWalker, ReportsExactlyWhatLeavesItsRegister) {
  expect_flags({Anchor::triangle, 16, 12, 64}, 0.01);
  expect_flags({Anchor::span, 16, 12, 64}, 0.01);
  expect_flags({Anchor::triangle, 30, 25, 4096}, 0.01);
  expect_flags({Anchor::span, 30, 25, 4096}, 0.01);
}

// Nothing is rounded when starts are exact, and rounded starts are known: a long span in a narrow
// register that fits must not be taken for one that does not.
TEST(SpanWalker, ReportsNothingThatFitsInLongSpansOfNarrowRegisters) {
  expect_flags({Anchor::triangle, 16, 12, 4096}, 0.01);
  expect_flags({Anchor::triangle, 8, 6, 1024}, 0.01);
  expect_flags({Anchor::span, 8, 6, 512}, 0.01);
}

TEST(SpanWalker, LooksAtEverySeriesInUse) {
  FrameConfiguration configuration;
  configuration.channels = 3;
  configuration.gate = GateSource::series;
  configuration.depth_cue = true;
  const SpanWalker walker(frame_of(configuration));
  const RowSpan row = {0, 0, 5};
  const auto everything = [] {
    TriangleSetup setup;
    setup.plan.gate = SeriesForm::fitted;
    setup.plan.depth_cue = true;
    return setup;
  };
  EXPECT_TRUE(walker.fits(everything(), row));
  const FixedQuadratic large = {std::int64_t{1} << 54, 0, 0, 0, 0, 0};
  for (int series = 0; series < 6; ++series) {
    TriangleSetup setup = everything();
    if (series < 3) setup.diffuse[static_cast<std::size_t>(series)] = large;
    if (series == 3) setup.gate = large;
    if (series == 4) setup.specular = large;
    if (series == 5) setup.cue_factor.c = large.t0;
    EXPECT_FALSE(walker.fits(setup, row)) << "series " << series;
    // What is not in use does not count.
    setup.plan.gate = setup.plan.specular = SeriesForm::absent;
    setup.plan.depth_cue = false;
    const SpanWalker grey(frame_of(FrameConfiguration()));
    EXPECT_EQ(grey.fits(setup, row), series != 0) << "series " << series;
  }
}

// Every field, of channels and series that are not in use too.
void expect_same(const Span& a, const Span& b) {
  const auto fields = [](const Span& s) {
    std::vector<std::int64_t> all = {s.row.x,         s.row.y,     s.row.length, s.row.lit,
                                     s.triangle,      s.table,     s.first_pass, s.step_diffuse,
                                     s.step_specular, s.highlight, s.depth,      s.depth_step};
    all.insert(all.end(), s.level.begin(), s.level.end());
    for (const SeriesStart* start :
         {&s.diffuse[0], &s.diffuse[1], &s.diffuse[2], &s.specular, &s.gate, &s.cue}) {
      all.insert(all.end(), {start->v, start->d1, start->d2});
    }
    return all;
  };
  EXPECT_EQ(fields(a), fields(b));
}

// Looks at every triangle that is set up, of random frames.
template <typename Look>
void for_random_triangles(unsigned frames, Look look) {
  for (unsigned seed = kSpanWalkerSeed; seed < kSpanWalkerSeed + frames; ++seed) {
    Random random(seed);
    const RandomEffects e = random_effects(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + text(e));
    const FrameSetup frame(e.scene, e.geometry,
                           with_derived_blocks(e.configuration, e.scene, e.geometry));
    const FrontEnd front_end(frame);
    TriangleWork work;
    for (TriangleOrder next(front_end); !next.done(); next.advance()) {
      if (front_end.set_up(next.triangle(), next.pass(), work) != SetupOutcome::ready) continue;
      look(frame.configuration, front_end.span_walker(), work);
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(SpanWalker, LeavesNothingOfTheSpanThatWasThere) {
  Span used;
  for_random_triangles(
      100, [&used](const FrameConfiguration&, const SpanWalker& walker, const TriangleWork& work) {
        for (const RowSpan& row : work.rows) {
          walker.start(work.setup, row, used);
          expect_same(used, walker.start(work.setup, row));
        }
        // As full as can be.
        used.specular = used.gate = used.cue = {1, 2, 3};
        used.diffuse.fill(used.gate);
        used.depth = used.depth_step = 4;
      });
}

// The datapath may hold the registers of what is not stepped, and take the level for the light
// where there is no diffuse series.
TEST(SpanWalker, WhatIsNotSteppedHasNoDifferences) {
  const auto expect_still = [](const SeriesStart& start) {
    EXPECT_EQ(start.d1, 0);
    EXPECT_EQ(start.d2, 0);
  };
  for_random_triangles(200, [&](const FrameConfiguration& configuration, const SpanWalker& walker,
                                const TriangleWork& work) {
    const Span span = walker.start(work.setup, work.rows.back());
    EXPECT_EQ(span.first_pass, work.setup.pass == 0);
    for (std::size_t c = 0; c < 3 && !span.step_diffuse; ++c) expect_still(span.diffuse[c]);
    if (!span.step_diffuse) expect_still(span.gate);
    if (!span.step_specular) expect_still(span.specular);
    EXPECT_LE(span.highlight, configuration.specular);
    EXPECT_LE(span.step_specular, configuration.specular);
    for (std::size_t c = 0; c < 3 && !configuration.diffuse; ++c) {
      EXPECT_EQ(span.diffuse[c].v, span.level[c]);
    }
  });
}

}  // namespace
}  // namespace phongpipe
