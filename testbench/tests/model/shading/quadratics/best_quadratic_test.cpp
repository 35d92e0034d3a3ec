// Minimax by Lawson's iteration: close to its lower bound, and better than every practical fit.
#include "model/shading/quadratics/best_quadratic.h"

#include <gtest/gtest.h>

#include "testbench/tests/model/shading/quadratics/random_cases.h"

namespace phongpipe {
namespace {

constexpr unsigned kBestQuadraticSeed = 12;

TEST(BestQuadratic, IsWithinTwoPercentOfItsLowerBound) {
  SCOPED_TRACE(kBestQuadraticSeed);
  RandomCases random(kBestQuadraticSeed);
  for (int n = 0; n < 40; ++n) {
    const CosineCase c = n % 2 == 0 ? random.diffuse(40) : random.specular(25, 60);
    const auto cosine = [&c](double u, double v) { return c.cosine(u, v); };
    const BestQuadratic best = best_quadratic(dense_samples(20, cosine), c.power);
    EXPECT_LE(best.lower_bound, best.error * (1 + 1e-9));
    EXPECT_LE(best.error, 1.02 * best.lower_bound) << "case " << n;
  }
}

TEST(BestQuadratic, StopsWhereTheErrorIsGoodEnough) {
  const CosineCase c = RandomCases(kBestQuadraticSeed).diffuse(40);
  const auto samples = dense_samples(20, [&c](double u, double v) { return c.cosine(u, v); });
  const double limit = best_quadratic(samples, 1).error;
  const double stopped = best_quadratic(samples, 1, 1.5 * limit).error;
  EXPECT_GT(stopped, limit);
  EXPECT_LE(stopped, 1.5 * limit);
}

TEST(BestQuadratic, OfAQuadraticIsItself) {
  const auto quadratic = [](double u, double v) {
    return 0.4 - 0.2 * u + 0.4 * v + 0.2 * u * u - 0.6 * u * v;
  };
  const BestQuadratic best = best_quadratic(dense_samples(8, quadratic), 1);
  EXPECT_LT(best.error, 1e-12);
  EXPECT_NEAR(best.values.middle[0], quadratic(0.5, 0.5), 1e-12);
}

TEST(BestQuadratic, BeatsEveryPracticalFit) {
  SCOPED_TRACE(kBestQuadraticSeed);
  RandomCases random(kBestQuadraticSeed);
  for (int n = 0; n < 60; ++n) {
    const CosineCase c = n % 2 == 0 ? random.diffuse(40) : random.specular(25, 20);
    const double limit = largest_error(c, best(c, 20), 20);
    for (const SeriesFit fit :
         {SeriesFit::taylor, SeriesFit::six_point, SeriesFit::weighted, SeriesFit::focused}) {
      EXPECT_GT(largest_error(c, fitted(fit, c), 20), 0.98 * limit) << "case " << n;
    }
  }
}

}  // namespace
}  // namespace phongpipe
