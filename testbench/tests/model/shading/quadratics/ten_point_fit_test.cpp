// Ten-point least squares in closed form, against the normal equations; exactness on quadratics.
#include "model/shading/quadratics/ten_point_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "model/shading/quadratics/nine_point_fit.h"
#include "testbench/tests/model/shading/quadratics/random_cases.h"

namespace phongpipe {
namespace {

constexpr unsigned kTenPointFitSeed = 11;
constexpr int kTenPointFitCases = 500;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// u and v of the ten points.
std::array<std::array<double, 2>, kTenPoints> points() {
  constexpr double kThird = 1.0 / 3, kSixth = 1.0 / 6;
  return {{{0, 0},
           {1, 0},
           {0, 1},
           {0.5, 0.5},
           {0, 0.5},
           {0.5, 0},
           {kSixth, kSixth},
           {4 * kSixth, kSixth},
           {kSixth, 4 * kSixth},
           {kThird, kThird}}};
}

Vector6 monomials(double u, double v) {
  Vector6 result;
  result << 1, u, v, u * u, u * v, v * v;
  return result;
}

double at(const Vector6& q, std::size_t point) {
  return q.dot(monomials(points()[point][0], points()[point][1]));
}

void expect_least_squares(const SixValues<double>& fit, const Values<double, kTenPoints>& f,
                          const Values<double, kTenPoints>& spread) {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  for (std::size_t i = 0; i < kTenPoints; ++i) {
    const Vector6 m = monomials(points()[i][0], points()[i][1]);
    normal += m * m.transpose() / spread[i];
    right += m * (f[i] / spread[i]);
  }
  const Vector6 q = normal.fullPivLu().solve(right);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(fit.corner[i], at(q, i), 1e-10);
    EXPECT_NEAR(fit.middle[i], at(q, 3 + i), 1e-10);
  }
}

TEST(TenPointFit, IsWeightedLeastSquares) {
  SCOPED_TRACE(kTenPointFitSeed);
  RandomCases random(kTenPointFitSeed);
  for (int n = 0; n < kTenPointFitCases; ++n) {
    Values<double, kTenPoints> f, spread;
    for (std::size_t i = 0; i < kTenPoints; ++i) {
      f[i] = random.uniform(-1, 1);
      spread[i] = std::exp(random.uniform(-3, 3));
    }
    expect_least_squares(fit_ten_points(f, spread), f, spread);
  }
}

TEST(SampledFits, ReproduceQuadratics) {
  SCOPED_TRACE(kTenPointFitSeed);
  RandomCases random(kTenPointFitSeed);
  for (int n = 0; n < kTenPointFitCases; ++n) {
    Vector6 q;
    for (Eigen::Index i = 0; i < 6; ++i) q[i] = random.uniform(-1, 1);
    Values<double, kTenPoints> f, spread;
    for (std::size_t i = 0; i < kTenPoints; ++i) {
      f[i] = at(q, i);
      spread[i] = std::exp(random.uniform(-3, 12));
    }
    Values<double, kNinePoints> nine;
    std::copy_n(f.begin(), kNinePoints, nine.begin());
    for (const SixValues<double>& fit : {fit_ten_points(f, spread), fit_nine_points(nine)}) {
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(fit.corner[i], f[i], 1e-9);
        EXPECT_NEAR(fit.middle[i], f[3 + i], 1e-9);
      }
    }
  }
}

// The change of basis, on a triangle anywhere.
TEST(BarycentricBasis, TakesItsSixValues) {
  SCOPED_TRACE(kTenPointFitSeed);
  RandomCases random(kTenPointFitSeed);
  for (int n = 0; n < kTenPointFitCases; ++n) {
    std::array<double, 3> x, y;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = random.uniform(-20, 20);
      y[i] = random.uniform(-20, 20);
    }
    const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (std::fabs(area) < 10) continue;
    const Interpolator<double> triangle(x, y);
    const BarycentricBasis<double> basis(triangle.coordinate_1(), triangle.coordinate_2());
    SixValues<double> values;
    for (std::size_t i = 0; i < 3; ++i) {
      values.corner[i] = random.uniform(-1, 1);
      values.middle[i] = random.uniform(-1, 1);
    }
    const Quadratic<double> q = basis(values);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      EXPECT_NEAR(q(x[i], y[i]), values.corner[i], 1e-9);
      EXPECT_NEAR(q((x[j] + x[k]) / 2, (y[j] + y[k]) / 2), values.middle[i], 1e-9);
    }
  }
}

}  // namespace
}  // namespace phongpipe
