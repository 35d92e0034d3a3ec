// The fits as the setup engine makes them: what each promises, and what it costs.
#include "model/shading/quadratics/cosine_series.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/schedule.h"
#include "testbench/tests/model/shading/quadratics/random_cases.h"
#include "testbench/tests/model/shading/six.h"

namespace phongpipe {
namespace {

constexpr unsigned kCosineSeriesSeed = 13;
constexpr int kTriangles = 301;
const std::array<SeriesFit, 4> kCosineSeriesFits = {SeriesFit::taylor, SeriesFit::six_point,
                                                    SeriesFit::weighted, SeriesFit::focused};

Spread errors(SeriesFit fit, double spread, double power) {
  RandomCases random(kCosineSeriesSeed);
  std::vector<double> values;
  for (int i = 0; i < kTriangles; ++i) {
    const CosineCase c = power == 1 ? random.diffuse(spread) : random.specular(spread, power);
    values.push_back(largest_error(c, fitted(fit, c), 30));
  }
  return spread_of(values);
}

std::size_t operations(SeriesFit fit) {
  SeriesPlan plan;
  plan.form.fit = fit;
  const OperationCounts c = record_setup(plan).counts();
  return c.add + c.multiply + c.rsqrt;
}

TEST(CosineSeries, DoesNotDependOnTheLengthOfTheNormals) {
  SCOPED_TRACE(kCosineSeriesSeed);
  RandomCases random(kCosineSeriesSeed);
  for (int i = 0; i < 200; ++i) {
    CosineCase c = random.specular(30, 20);
    for (const SeriesFit fit : kCosineSeriesFits) {
      CosineCase longer = c;
      for (Vec& n : longer.normal) n *= 3.7;
      const auto t = six(fitted(fit, c)), scaled = six(fitted(fit, longer));
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(t[k], scaled[k], 1e-10);
    }
  }
}

// What is left out of a triangle's setup must not change the other.
TEST(CosineSeries, EitherAloneIsTheSameToTheBit) {
  SCOPED_TRACE(kCosineSeriesSeed);
  RandomCases random(kCosineSeriesSeed);
  for (int i = 0; i < 200; ++i) {
    const CosineCase c = random.specular(30, 20);
    const Interpolator<double> interpolate({0, 9, 2}, {0, 1, 8});
    const Corners<double> halfway = {c.m, c.normal[0], c.normal[2]};
    for (const SeriesFit fit : kCosineSeriesFits) {
      const SeriesWanted light_only = {true, false}, highlight_only = {false, true};
      const auto alone = [&](const auto& m, const SeriesWanted& wanted) {
        return fit_series(fit, interpolate, c.normal, c.m, m, 19.0, wanted);
      };
      const auto light = six(alone(c.m, light_only).light);
      const auto at_infinity = fit_series(fit, interpolate, c.normal, c.m, c.m, 19.0);
      const auto local = fit_series(fit, interpolate, c.normal, c.m, halfway, 19.0);
      EXPECT_EQ(light, six(at_infinity.light));
      EXPECT_EQ(light, six(local.light));
      EXPECT_EQ(six(alone(c.m, highlight_only).highlight), six(at_infinity.highlight));
      EXPECT_EQ(six(alone(halfway, highlight_only).highlight), six(local.highlight));
    }
  }
}

// What it costs in LSB when corners come in another order is nothing.
TEST(CosineSeries, DoesNotDependOnTheOrderOfTheCorners) {
  SCOPED_TRACE(kCosineSeriesSeed);
  RandomCases random(kCosineSeriesSeed);
  for (int i = 0; i < 200; ++i) {
    const CosineCase c = random.specular(30, 20);
    for (const SeriesFit fit : kCosineSeriesFits) {
      const Interpolator<double> there({0, 9, 2}, {0, 1, 8}), back({2, 9, 0}, {8, 1, 0});
      const auto& n = c.normal;
      const auto a = fit_series(fit, there, n, c.m, c.m, 19.0);
      const auto b = fit_series(fit, back, {n[2], n[1], n[0]}, c.m, c.m, 19.0);
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(six(a.light)[k], six(b.light)[k], 1e-10);
        EXPECT_NEAR(six(a.highlight)[k], six(b.highlight)[k], 1e-10);
      }
    }
  }
}

TEST(SixPoint, SamplesAreTheSameToTheBitFromBothSidesOfAnEdge) {
  SCOPED_TRACE(kCosineSeriesSeed);
  RandomCases random(kCosineSeriesSeed);
  for (int i = 0; i < 1000; ++i) {
    const std::array<Vec, 3> n = random.normals(40), m = random.normals(20);
    const Vec light = random.unit(), other = random.unit();
    // The edge from n[1] to n[2] faces corner 0 here, and corner 1 on the other side.
    const NormalSamples<double, kSixPoints> here(n), there({n[2], other, n[1]});
    const Corners<double> m_there = {m[2], light, m[1]};
    EXPECT_EQ(here.cosines(light)[3], there.cosines(light)[4]);
    EXPECT_EQ(here.cosines(light)[1], there.cosines(light)[2]);
    EXPECT_EQ(here.cosines(light)[2], there.cosines(light)[0]);
    EXPECT_EQ(here.cosines(m)[3], there.cosines(m_there)[4]);
    EXPECT_EQ(here.cosines(m)[1], there.cosines(m_there)[2]);
  }
}

TEST(SixPoint, HasNoSeams) {
  SCOPED_TRACE(kCosineSeriesSeed);
  RandomCases random(kCosineSeriesSeed);
  for (int i = 0; i < 200; ++i) {
    const std::array<Vec, 3> n = random.normals(60);
    const Vec light = random.unit();
    const Interpolator<double> here({3, -20, 11}, {30, 2, -4}), there({-20, -25, 11}, {2, -19, -4});
    const Corners<double> across = {n[1], random.normals(60)[0], n[2]};
    const auto a = fit_series(SeriesFit::six_point, here, n, light, light, 19.0).light;
    const auto b = fit_series(SeriesFit::six_point, there, across, light, light, 19.0).light;
    for (double t = 0; t <= 1; t += 0.125) {
      const double x = -20 + 31 * t, y = 2 - 6 * t;
      EXPECT_NEAR(a(x, y), b(x, y), 1e-12);
    }
  }
}

// Medians of NUMERICS section 4, to a quarter.
TEST(CosineSeries, ErrorsAreThoseOfTheAnalysis) {
  SCOPED_TRACE(kCosineSeriesSeed);
  struct Row {
    double spread, power, taylor, six_point, weighted;
  };
  for (const Row& row :
       {Row{20, 1, 0.53, 0.16, 0}, Row{30, 1, 1.8, 0.52, 0}, Row{20, 20, 1.5, 0.55, 0.43},
        Row{30, 20, 3.6, 2.5, 1.4}, Row{45, 20, 11, 12, 4.7}, Row{15, 164, 1.1, 1.2, 0.48},
        Row{20, 164, 2.0, 3.7, 1.0}, Row{30, 164, 4.4, 17, 4.1}}) {
    SCOPED_TRACE(testing::Message() << row.spread << " degrees, power " << row.power);
    const double weighted = errors(SeriesFit::weighted, row.spread, row.power).median;
    EXPECT_NEAR(errors(SeriesFit::six_point, row.spread, row.power).median / row.six_point, 1, 0.3);
    if (row.power == 1) {
      EXPECT_NEAR(errors(SeriesFit::taylor, row.spread, 1).median / row.taylor, 1, 0.25);
    } else {
      EXPECT_NEAR(weighted / row.weighted, 1, 0.25);
    }
  }
}

// Largest errors against the best quadratics', at no more than four times the paper's setup.
TEST(Focused, IsNearTheBestQuadratic) {
  EXPECT_LE(operations(SeriesFit::focused), 4 * operations(SeriesFit::taylor));
  struct Row {
    double spread, power, median_ratio;
  };
  for (const Row& row :
       {Row{20, 1, 1.5}, Row{30, 1, 1.5}, Row{60, 1, 1.5}, Row{20, 20, 1.5}, Row{30, 20, 1.5},
        Row{45, 20, 1.5}, Row{15, 164, 1.5}, Row{20, 164, 1.7}, Row{30, 164, 2.0}}) {
    RandomCases random(kCosineSeriesSeed);
    std::vector<double> ratios;
    for (int i = 0; i < 61; ++i) {
      const CosineCase c =
          row.power == 1 ? random.diffuse(row.spread) : random.specular(row.spread, row.power);
      ratios.push_back(largest_error(c, fitted(SeriesFit::focused, c), 20) /
                       largest_error(c, best(c, 20), 20));
    }
    EXPECT_LE(spread_of(ratios).median, row.median_ratio)
        << row.spread << " degrees, power " << row.power;
  }
}

TEST(CosineSeries, MoreOperationsLeaveLessError) {
  EXPECT_LT(operations(SeriesFit::taylor), operations(SeriesFit::six_point));
  EXPECT_LT(operations(SeriesFit::six_point), operations(SeriesFit::weighted));
  EXPECT_LT(operations(SeriesFit::weighted), operations(SeriesFit::focused));
  EXPECT_LT(3 * errors(SeriesFit::six_point, 30, 1).median,
            errors(SeriesFit::taylor, 30, 1).median);
  for (const auto& [spread, power] : {std::pair(30, 20), std::pair(20, 164)}) {
    const double six = errors(SeriesFit::six_point, spread, power).median;
    const double weighted = errors(SeriesFit::weighted, spread, power).median;
    EXPECT_LT(1.4 * weighted, six);
    EXPECT_LE(errors(SeriesFit::focused, spread, power).median, 1.02 * weighted);
  }
  // Where the highlight is small in the triangle.
  for (const auto& [spread, power] : {std::pair(45, 20), std::pair(30, 164)}) {
    EXPECT_LT(1.15 * errors(SeriesFit::focused, spread, power).median,
              errors(SeriesFit::weighted, spread, power).median);
  }
}

// Unlit by a material that does not shine, or the other way round: half the work is enough.
TEST(CosineSeries, WhatIsNotWantedIsNotExecuted) {
  const auto counts = [](SeriesFit fit, const SeriesWanted& wanted) {
    Recording recording;
    const Corners<Recorded> normal;
    const Vector3<Recorded> light, halfway;
    fit_series(fit, unit_triangle<Recorded>(), normal, light, halfway, Recorded(), wanted);
    return recording.dataflow().counts();
  };
  SCOPED_TRACE(kCosineSeriesSeed);
  RandomCases random(kCosineSeriesSeed);
  for (const SeriesFit fit : kCosineSeriesFits) {
    const OperationCounts both = counts(fit, {true, true});
    for (const SeriesWanted& one : {SeriesWanted{true, false}, SeriesWanted{false, true}}) {
      EXPECT_LT(counts(fit, one).multiply, both.multiply);
      EXPECT_LT(counts(fit, one).add, both.add);
      const CosineCase c = random.specular(30, 20);
      const auto triangle = unit_triangle<double>();
      const auto all = fit_series(fit, triangle, c.normal, c.m, c.m, 19.0);
      const auto some = fit_series(fit, triangle, c.normal, c.m, c.m, 19.0, one);
      const auto light = six(one.light ? all.light : Quadratic<double>{});
      const auto highlight = six(one.highlight ? all.highlight : Quadratic<double>{});
      EXPECT_EQ(six(some.light), light);
      EXPECT_EQ(six(some.highlight), highlight);
    }
  }
}

// A middle without a normal has no cosine; the setup engine reports what is not a number.
TEST(CosineSeries, OpposedNormalsAreNotANumber) {
  const std::array<Vec, 3> n = {Vec(1, 0, 0), Vec(-1, 0, 0), Vec(0, 0, 1)};
  for (const SeriesFit fit : {SeriesFit::six_point, SeriesFit::weighted, SeriesFit::focused}) {
    const CosineSeries<double> series =
        fit_series(fit, unit_triangle<double>(), n, Vec(0, 0.6, 0.8), Vec(0, 0, 1), 19.0);
    EXPECT_FALSE(std::isfinite(series.light.t5));
    EXPECT_FALSE(std::isfinite(series.highlight.t5));
  }
}

// Nothing to focus on: a flat triangle, and powers at both ends.
TEST(Focused, FlatTrianglesAndExtremePowersAreFinite) {
  for (const double power : {0.0, 1.0, 164.0, 10000.0}) {
    for (const Vec& halfway : {Vec(0, 0, 1), Vec(1, 0, 0), Vec(0, 0, -1), Vec(0, 0, 0)}) {
      const std::array<Vec, 3> n = {Vec(0, 0, 1), Vec(0, 0, 1), Vec(0, 0, 1)};
      const double sharpness = std::max(0.0, power - 1);
      const auto q = fit_series(SeriesFit::focused, unit_triangle<double>(), n, Vec(0, 0, 1),
                                halfway, sharpness)
                         .highlight;
      EXPECT_NEAR(q.t0, halfway.z(), 1e-9);
      for (const double t : {q.t1, q.t2, q.t3, q.t4, q.t5}) EXPECT_NEAR(t, 0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace phongpipe
