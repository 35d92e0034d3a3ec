// The Taylor series of Bishop & Weimer against truncated power series computed here, and the errata
// of NUMERICS section 1 against the forms as printed.
#include "model/shading/taylor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "testbench/system/random.h"
#include "testbench/tests/model/shading/six.h"

namespace phongpipe {
namespace {

using Vec = Vector3<double>;
using Real = long double;

// 1, x, y, x², xy, y²; everything of third degree is dropped.
struct Jet {
  std::array<Real, 6> c = {};
};
Jet operator+(const Jet& p, const Jet& q) {
  Jet sum;
  for (std::size_t i = 0; i < 6; ++i) sum.c[i] = p.c[i] + q.c[i];
  return sum;
}
Jet operator*(const Jet& p, const Jet& q) {
  const auto& [p0, px, py, pxx, pxy, pyy] = p.c;
  const auto& [q0, qx, qy, qxx, qxy, qyy] = q.c;
  return {{p0 * q0, p0 * qx + px * q0, p0 * qy + py * q0, p0 * qxx + px * qx + pxx * q0,
           p0 * qxy + px * qy + py * qx + pxy * q0, p0 * qyy + py * qy + pyy * q0}};
}
// u^(−1/2) = u0^(−1/2) (1 − e/2 + 3e²/8) with u = u0 (1 + e).
Jet inverse_root(const Jet& u) {
  Jet e;
  for (std::size_t i = 1; i < 6; ++i) e.c[i] = u.c[i] / u.c[0];
  const Jet e2 = e * e;
  Jet result;
  result.c[0] = 1;
  for (std::size_t i = 0; i < 6; ++i) result.c[i] += -e.c[i] / 2 + 3 * e2.c[i] / 8;
  for (Real& c : result.c) c /= std::sqrt(u.c[0]);
  return result;
}
Jet dot(const Linear<Vec>& p, const Linear<Vec>& q) {
  Jet sum;
  for (int i = 0; i < 3; ++i) {
    sum = sum + Jet{{p.c[i], p.a[i], p.b[i], 0, 0, 0}} * Jet{{q.c[i], q.a[i], q.b[i], 0, 0, 0}};
  }
  return sum;
}

Six series_of_cosine(const Linear<Vec>& n, const Linear<Vec>& m) {
  const Jet s = dot(n, m) * inverse_root(dot(n, n)) * inverse_root(dot(m, m));
  Six t;
  const std::array<std::size_t, 6> order = {0, 2, 1, 5, 4, 3};
  for (std::size_t i = 0; i < 6; ++i) t[i] = static_cast<double>(s.c[order[i]]);
  return t;
}

double relative_difference(const Six& t, const Six& expected) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    difference = std::max(difference, std::fabs(t[i] - expected[i]));
    size = std::max(size, std::fabs(expected[i]));
  }
  return difference / size;
}

std::string text(const Six& t) {
  std::string result;
  for (const double value : t) result += std::to_string(value) + " ";
  return result;
}

Vec random_vector(Random& random) {
  return Vec{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

// Of any size and steepness that keeps C away from 0.
Linear<Vec> random_linear(Random& random) {
  const Vec a = random_vector(random), b = random_vector(random);
  const double length = random.uniform(0.5, 2);
  return {a, b, length * random.unit()};
}

constexpr unsigned kTaylorSeed = 1986;
constexpr int kTaylorCases = 2000;
constexpr double kTaylorAgree = 1e-12;  // measured: infinite 2.0e-15, finite 2.7e-15

TEST(NormalExpansion, InfiniteIsTheTruncatedPowerSeries) {
  SCOPED_TRACE(kTaylorSeed);
  Random random(kTaylorSeed);
  double worst = 0;
  for (int i = 0; i < kTaylorCases; ++i) {
    const Linear<Vec> n = random_linear(random);
    const Vec light = random.unit();
    const Six t = six(NormalExpansion<double>(n).infinite(light));
    const Six expected = series_of_cosine(n, {Vec::Zero(), Vec::Zero(), light});
    ASSERT_LT(relative_difference(t, expected), kTaylorAgree) << "case " << i << "\n"
                                                              << text(t) << "\n"
                                                              << text(expected);
    worst = std::max(worst, relative_difference(t, expected));
  }
  RecordProperty("largest_relative_difference", std::to_string(worst * 1e15) + "e-15");
}

TEST(NormalExpansion, FiniteIsTheTruncatedPowerSeries) {
  SCOPED_TRACE(kTaylorSeed);
  Random random(kTaylorSeed);
  double worst = 0;
  for (int i = 0; i < kTaylorCases; ++i) {
    const Linear<Vec> n = random_linear(random), m = random_linear(random);
    const Six t = six(NormalExpansion<double>(n).finite(m));
    const Six expected = series_of_cosine(n, m);
    ASSERT_LT(relative_difference(t, expected), kTaylorAgree) << "case " << i << "\n"
                                                              << text(t) << "\n"
                                                              << text(expected);
    worst = std::max(worst, relative_difference(t, expected));
  }
  RecordProperty("largest_relative_difference", std::to_string(worst * 1e15) + "e-15");
}

// T5's printed error vanishes on symmetric triangles: so expand about a corner, too.
TEST(NormalExpansion, HoldsAboutACornerAsWellAsAboutTheCentre) {
  SCOPED_TRACE(kTaylorSeed);
  Random random(kTaylorSeed);
  for (int i = 0; i < kTaylorCases; ++i) {
    const Vec axis = random.unit(), light = random.unit();
    std::array<Vec, 3> n, m;
    for (Vec& normal : n) normal = random.unit_near(axis, 40);
    for (Vec& halfway : m) halfway = random.unit_near(axis, 17);
    const std::array<double, 3> x = {0, random.uniform(10, 40), random.uniform(-5, 5)};
    const std::array<double, 3> y = {0, random.uniform(-5, 5), random.uniform(10, 40)};
    for (const bool corner : {true, false}) {
      const double cx = corner ? 0 : (x[0] + x[1] + x[2]) / 3;
      const double cy = corner ? 0 : (y[0] + y[1] + y[2]) / 3;
      const Interpolator<double> interpolate({x[0] - cx, x[1] - cx, x[2] - cx},
                                             {y[0] - cy, y[1] - cy, y[2] - cy});
      const Linear<Vec> normal = interpolate(n[0], n[1], n[2]);
      const Linear<Vec> halfway = interpolate(m[0], m[1], m[2]);
      const NormalExpansion<double> expansion(normal);
      // T5 is small in pixels^−2: compare with coordinates in units of the triangle.
      const auto per_triangle = [](Six t) {
        return Six{t[0], t[1] * 25, t[2] * 25, t[3] * 625, t[4] * 625, t[5] * 625};
      };
      EXPECT_LT(relative_difference(
                    per_triangle(six(expansion.infinite(light))),
                    per_triangle(series_of_cosine(normal, {Vec::Zero(), Vec::Zero(), light}))),
                kTaylorAgree)
          << "infinite, case " << i << (corner ? " corner" : " centre");
      EXPECT_LT(relative_difference(per_triangle(six(expansion.finite(halfway))),
                                    per_triangle(series_of_cosine(normal, halfway))),
                kTaylorAgree)
          << "finite, case " << i << (corner ? " corner" : " centre");
    }
  }
}

TEST(NormalExpansion, DoesNotDependOnTheLengthOfTheNormals) {
  SCOPED_TRACE(kTaylorSeed);
  Random random(kTaylorSeed);
  for (int i = 0; i < kTaylorCases; ++i) {
    const Linear<Vec> n = random_linear(random), m = random_linear(random);
    const double k = random.uniform(0.01, 100);
    const Linear<Vec> scaled = {k * n.a, k * n.b, k * n.c};
    const Vec light = random.unit();
    EXPECT_LT(relative_difference(six(NormalExpansion<double>(scaled).infinite(light)),
                                  six(NormalExpansion<double>(n).infinite(light))),
              kTaylorAgree)
        << "case " << i << ", times " << k;
    EXPECT_LT(relative_difference(six(NormalExpansion<double>(scaled).finite(m)),
                                  six(NormalExpansion<double>(n).finite(m))),
              kTaylorAgree)
        << "case " << i << ", times " << k;
  }
}

TEST(Interpolator, ReproducesTheCornersAndWhatIsBetween) {
  SCOPED_TRACE(kTaylorSeed);
  Random random(kTaylorSeed);
  for (int i = 0; i < kTaylorCases; ++i) {
    // Corners around a circle, in either order, so that no case is a sliver.
    const double start = random.uniform(0, 6), turn = i % 2 == 0 ? 2.1 : -2.1;
    std::array<double, 3> x, y, q;
    for (std::size_t v = 0; v < 3; ++v) {
      const double angle = start + static_cast<double>(v) * turn;
      x[v] = 7 + random.uniform(10, 40) * std::cos(angle);
      y[v] = -3 + random.uniform(10, 40) * std::sin(angle);
      q[v] = random.uniform(-1, 1);
    }
    const Linear<double> line = Interpolator<double>(x, y)(q[0], q[1], q[2]);
    const auto at = [&line](double px, double py) { return line.a * px + line.b * py + line.c; };
    for (std::size_t v = 0; v < 3; ++v) {
      EXPECT_NEAR(at(x[v], y[v]), q[v], 1e-14) << "case " << i << ", corner " << v;
    }
    EXPECT_NEAR(at((x[0] + x[1] + x[2]) / 3, (y[0] + y[1] + y[2]) / 3), (q[0] + q[1] + q[2]) / 3,
                1e-14)
        << "case " << i;
  }
}

}  // namespace
}  // namespace phongpipe
