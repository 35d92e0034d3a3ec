// The bounds by which setup leaves light and highlights out: no series exceeds them, on triangles
// that turn by up to 120°, and where triangles turn little they are near what they bound.
#include "model/shading/quadratics/series_bound.h"

#include <gtest/gtest.h>

#include <string>

#include "model/shading/triangle_setup.h"
#include "testbench/tests/model/shading/quadratics/random_cases.h"

namespace phongpipe {
namespace {

constexpr int kSeriesBoundCases = 4000;
constexpr int kSteps = 30;  // of the grid a triangle is looked at on, corners and edges included
// Double precision in some hundred operations on numbers near 1.
constexpr double kSeriesBoundNoise = 1e-12;

class SeriesBound : public testing::TestWithParam<unsigned> {
 protected:
  // Normals across a cone of up to `widest` degrees. Those of every other case have lengths of
  // their own, as clipping and splitting make them.
  static std::array<Vec, 3> normals(RandomCases& random, int i, double widest) {
    std::array<Vec, 3> n = random.normals(random.uniform(0, widest));
    if (i % 2 == 1) {
      for (Vec& normal : n) normal *= random.uniform(0.5, 1.5);
    }
    return n;
  }
  // A third of the directions lies near one of the triangle's, a third near a right angle to it,
  // where signs are decided.
  static Vec direction(RandomCases& random, int i, const std::array<Vec, 3>& n) {
    if (i % 3 == 0) return random.unit();
    const Vec near = (n[0] + n[1] + n[2] + 0.3 * random.unit()).normalized();
    return i % 3 == 1 ? near : Vec(near.cross(random.unit()).normalized());
  }
};

TriangleInput<double> triangle_of(const std::array<Vec, 3>& normal) {
  TriangleInput<double> input;
  constexpr double kNear = -1.0 / 3, kFar = 2.0 / 3;
  input.x = {kNear, kFar, kNear};
  input.y = {kNear, kNear, kFar};
  input.normal = normal;
  return input;
}

template <typename Visit>
void for_each_point(Visit visit) {
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      visit(static_cast<double>(i) / kSteps, static_cast<double>(j) / kSteps);
    }
  }
}

double highest(const Quadratic<double>& q) {
  double most = -1e9;
  for_each_point([&](double u, double v) { most = std::max(most, q(u - 1.0 / 3, v - 1.0 / 3)); });
  return most;
}

TEST_P(SeriesBound, IsNotExceededByAnySeries) {
  RandomCases random(GetParam());
  for (int i = 0; i < kSeriesBoundCases; ++i) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", case " + std::to_string(i));
    const std::array<Vec, 3> n = normals(random, i, 120);
    LightInput<double> light;
    light.terms.to_light = direction(random, i, n);
    light.terms.halfway = direction(random, i / 3, n);
    light.terms.sharpness = random.uniform(0, 200);
    for (const SeriesFit fit : {SeriesFit::six_point, SeriesFit::weighted, SeriesFit::focused}) {
      SeriesPlan plan;
      plan.form.fit = fit;
      plan.bound_light = plan.bound_highlight = true;
      const TriangleBounds<double> bounds = bound_triangle(plan, triangle_of(n), light);
      const CosineSeries<double> series =
          fit_series(fit, unit_triangle<double>(), n, light.terms.to_light, light.terms.halfway,
                     light.terms.sharpness);
      ASSERT_LE(highest(series.light), bounds.light.high + kSeriesBoundNoise)
          << "fit " << static_cast<int>(fit);
      ASSERT_LE(highest(series.light.scaled(-1)), kSeriesBoundNoise - bounds.light.low);
      // Of a highlight whatever the plan's fit, that of six points is bounded.
      if (fit == SeriesFit::six_point) {
        ASSERT_LE(highest(series.highlight), bounds.highlight.high + kSeriesBoundNoise);
        ASSERT_LE(highest(series.highlight.scaled(-1)), kSeriesBoundNoise - bounds.highlight.low);
      }
    }
  }
}

// Each factor of the bound by itself, so that slack in one does not hide another's fault.
TEST_P(SeriesBound, HoldsLengthsAndCosinesOfTheNormals) {
  RandomCases random(GetParam());
  for (int i = 0; i < kSeriesBoundCases; ++i) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", case " + std::to_string(i));
    const std::array<Vec, 3> n = normals(random, i, 120);
    const Vec m = direction(random, i, n);
    const FieldExtent<double> extent(squared_length(n));
    const CosineRange<double> range = cosine_range(n, extent, m);
    double shortest = 1e9;
    for_each_point([&](double u, double v) {
      const Vec normal = n[0] * (1 - u - v) + n[1] * u + n[2] * v;
      const double cosine = normal.dot(m) / normal.norm();
      shortest = std::min(shortest, normal.norm());
      ASSERT_LE(1 / normal.norm(), extent.inverse_shortest * (1 + kSeriesBoundNoise));
      ASSERT_GE(1 / normal.norm(), extent.inverse_longest * (1 - kSeriesBoundNoise));
      ASSERT_LE(cosine, range.high + kSeriesBoundNoise);
      ASSERT_GE(cosine, range.low - kSeriesBoundNoise);
    });
    // About the best of the edges' middles, which is a point of the triangle.
    double way = 1e9;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec middle = (n[(k + 1) % 3] + n[(k + 2) % 3]) / 2;
      double longest = 0;
      for (const Vec& corner : n) longest = std::max(longest, (corner - middle).norm());
      way = std::min(way, longest);
    }
    EXPECT_GE(extent.turn * (1 + kSeriesBoundNoise) + kSeriesBoundNoise, way / shortest);
  }
}

// About any point of the triangle, by the way from that point.
TEST_P(SeriesBound, HoldsTheRemainderOfATaylorSeriesAboutAnyPoint) {
  RandomCases random(GetParam());
  double largest_share = 0;
  for (int i = 0; i < kSeriesBoundCases; ++i) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", case " + std::to_string(i));
    const std::array<Vec, 3> n = normals(random, i, 120);
    const Vec m = direction(random, i, n);
    double u0 = random.uniform(0, 1), v0 = random.uniform(0, 1);
    if (u0 + v0 > 1) u0 = 1 - u0, v0 = 1 - v0;
    const Linear<Vec> normal = {n[1] - n[0], n[2] - n[0],
                                n[0] * (1 - u0 - v0) + n[1] * u0 + n[2] * v0};
    const Quadratic<double> series = NormalExpansion<double>(normal).infinite(m);
    double way = 0, shortest = 1e9;
    for (const Vec& corner : n) way = std::max(way, (corner - normal.c).norm());
    for_each_point([&](double u, double v) {
      shortest = std::min(shortest, (n[0] * (1 - u - v) + n[1] * u + n[2] * v).norm());
    });
    // A grid misses the shortest normal by little: h is a step of it, and |N|² has a curvature of
    // |N'|² ≤ (2 way)² along it, so that the square is missed by (2 way / kSteps)² at most.
    const double step = 2 * way / kSteps;
    shortest = std::sqrt(std::max(1e-12, shortest * shortest - step * step));
    const double remainder = taylor_remainder(way / shortest);
    for_each_point([&](double u, double v) {
      const Vec at = normal.a * (u - u0) + normal.b * (v - v0) + normal.c;
      const double error = std::fabs(series(u - u0, v - v0) - at.dot(m) / at.norm());
      ASSERT_LE(error, remainder + kSeriesBoundNoise) << "about (" << u0 << ", " << v0 << ")";
      if (remainder > 1e-6) largest_share = std::max(largest_share, error / remainder);
    });
  }
  EXPECT_GT(largest_share, 0.7) << "the cases are too tame to test the bound";
}

// How far a bound lies above the highest exact cosine, for unit normals across a cone of angle a in
// radians. |N|² is bounded by the products of two corners, cos a or so, hence 1/|N| by 1 + a²/4;
// the remainder is (1 + 2.47) τ³/2 with τ about the best middle of an edge, near ¾ a and below 0.8
// a. At 5°, 10° and 20° that is 0.003, 0.012 and 0.07; 0.002, 0.010 and 0.055 have been seen.
TEST_P(SeriesBound, IsNearTheHighestCosineWhereNormalsTurnLittle) {
  RandomCases random(GetParam());
  for (int i = 0; i < kSeriesBoundCases; ++i) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", case " + std::to_string(i));
    const double degrees = random.uniform(0, 25), angle = degrees * kDegrees;
    const std::array<Vec, 3> n = random.normals(degrees);
    LightInput<double> light;
    light.terms.to_light = light.terms.halfway = random.unit();
    SeriesPlan plan;
    plan.form.fit = SeriesFit::weighted;
    plan.bound_light = plan.bound_highlight = true;
    const TriangleBounds<double> bounds = bound_triangle(plan, triangle_of(n), light);
    double most = -1;
    for_each_point([&](double u, double v) {
      const Vec normal = n[0] * (1 - u - v) + n[1] * u + n[2] * v;
      most = std::max(most, normal.dot(light.terms.to_light) / normal.norm());
    });
    const double margin = bounds.light.high - most;
    ASSERT_LE(margin, angle * angle / 4 + 0.9 * angle * angle * angle + kSeriesBoundNoise)
        << degrees;
    ASSERT_LE(bounds.highlight.high, bounds.light.high) << "six points have the smaller norm";
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SeriesBound, testing::Values(5U, 6U, 7U));

struct Place {
  double u = 0, v = 0;
};

// The fixed points of cosine_samples.h.
constexpr double kInner = 1.0 / 6, kOuter = 2.0 / 3;
constexpr Place kPoints[] = {{0, 0},           {1, 0},           {0, 1},
                             {0.5, 0.5},       {0, 0.5},         {0.5, 0},
                             {kInner, kInner}, {kOuter, kInner}, {kInner, kOuter}};

double squared_distance(const Place& p, const Place& q) {
  return (p.u - q.u) * (p.u - q.u) + (p.v - q.v) * (p.v - q.v);
}

// ‖P‖ from the fit itself: the largest sum of what values of ±1 can give, and about where it is, a
// little beside the fit's points.
template <std::size_t points>
struct NormOf {
  std::array<Quadratic<double>, points> basis_functions;
  double norm = 0, norm_beside = 0;
  Place place;

  template <typename Fit>
  explicit NormOf(Fit fit) {
    const Interpolator<double> triangle = unit_triangle<double>();
    const BarycentricBasis<double> basis(triangle.coordinate_1(), triangle.coordinate_2());
    for (std::size_t k = 0; k < points; ++k) {
      Values<double, points> one{};
      one[k] = 1;
      basis_functions[k] = basis(fit(one));
    }
    constexpr int kFine = 400;
    for (int i = 0; i <= kFine; ++i) {
      for (int j = 0; i + j <= kFine; ++j) {
        const Place at = {static_cast<double>(i) / kFine, static_cast<double>(j) / kFine};
        double sum = 0;
        for (std::size_t k = 0; k < points; ++k) sum += std::fabs(value(k, at));
        norm = std::max(norm, sum);
        const bool beside =
            std::all_of(std::begin(kPoints), std::end(kPoints),
                        [&](const Place& p) { return squared_distance(p, at) > 1e-4; });
        if (beside && sum > norm_beside) norm_beside = sum, place = at;
      }
    }
  }
  double value(std::size_t k, const Place& at) const {
    return basis_functions[k](at.u - 1.0 / 3, at.v - 1.0 / 3);
  }
};

// A function that is off its Taylor series T by as much as it may, everywhere in the direction that
// hurts: T has its peak at the worst place, where the function is lower by the remainder, and the
// values at the fit's points are off by the remainder so that all add up there. What the fit then
// has there is the bound, and hardly less. A grid misses a kink of the norm by less than a
// thousandth.
template <std::size_t points, typename Fit>
void expect_reached(Fit fit, double norm) {
  const NormOf<points> of(fit);
  EXPECT_LE(of.norm, norm + 1e-12);
  EXPECT_GT(of.norm, norm - 1e-3);
  constexpr double kRemainder = 0.01, kPeak = 0.7, kFall = 1e4;
  double fitted = 0;
  const double highest = kPeak - kRemainder;
  for (std::size_t k = 0; k < points; ++k) {
    const double basis = of.value(k, of.place);
    const double sample = kPeak - kFall * squared_distance(kPoints[k], of.place) +
                          (basis > 0 ? kRemainder : -kRemainder);
    ASSERT_LE(sample, highest) << "the function is not below its own highest value";
    fitted += basis * sample;
  }
  const double bound =
      series_range(CosineRange<double>(highest, highest, 1, 1), kRemainder, norm).high;
  EXPECT_LE(fitted, bound + 1e-9);
  EXPECT_GT(fitted, bound - 0.1 * kRemainder);
}

TEST(FitNorm, IsReachedBySixPoints) {
  expect_reached<kSixPoints>(
      [](const Values<double, kSixPoints>& f) {
        return SixValues<double>{{f[0], f[1], f[2]}, {f[3], f[4], f[5]}};
      },
      kSixPointNorm);
}

TEST(FitNorm, IsReachedByNinePoints) {
  expect_reached<kNinePoints>(
      [](const Values<double, kNinePoints>& f) { return fit_nine_points(f); }, kNinePointNorm);
}

}  // namespace
}  // namespace phongpipe
