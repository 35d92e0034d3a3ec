// How far a Taylor series is off over its triangle (NUMERICS section 4): the gate that decides
// which triangles it may shade stands on these figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/shading/taylor.h"
#include "testbench/tests/model/shading/random_normals.h"

namespace phongpipe {
namespace {

constexpr double kLsb = 1.0 / 255;

class RandomTriangles : public RandomNormals {
 public:
  using RandomNormals::RandomNormals;

  // Three normals evenly around an axis: `spread` is between any two of them, in radians.
  std::array<Vec, 3> normals(double spread) {
    return cone(std::asin(std::sin(spread / 2) / std::sin(60 * kDegrees)), 6.3);
  }
};

struct DiffuseError {
  double tau;      // max |Nᵢ − C| / |C|, C the mean of the normals
  double largest;  // over the triangle, 1 is full scale
};

// N·L is affine invariant: the triangle's shape on the screen does not matter, its normals do.
DiffuseError diffuse_error(const std::array<Vec, 3>& n, const Vec& light) {
  const Interpolator<double> interpolate({-1, 2, -1}, {-1, -1, 2});  // about the centroid
  const Linear<Vec> normal = interpolate(n[0], n[1], n[2]);
  const Quadratic<double> series = NormalExpansion<double>(normal).infinite(light);
  DiffuseError error = {0, 0};
  for (const Vec& corner : n) {
    error.tau = std::max(error.tau, (corner - normal.c).norm() / normal.c.norm());
  }
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double x = -1 + 3.0 * i / kSteps, y = -1 + 3.0 * j / kSteps;
      const Vec exact = (normal.a * x + normal.b * y + normal.c).normalized();
      error.largest = std::max(error.largest, std::fabs(series(x, y) - exact.dot(light)));
    }
  }
  return error;
}

// Not proved in two dimensions: so it is looked for again with every run.
TEST(TaylorError, OfDiffuseLightIsWithinTheGate) {
  constexpr unsigned kSeed = 3;
  SCOPED_TRACE(kSeed);
  RandomTriangles random(kSeed);
  double largest_ratio = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::array<Vec, 3> normals = random.normals(random.uniform(1, 80) * kDegrees);
    // Half of the lights lie near the plane of the normals' spread, where the error is largest.
    Vec light = random.unit();
    if (i % 2 == 0) light = (normals[0] - normals[1] + 0.3 * random.unit()).normalized();
    const DiffuseError error = diffuse_error(normals, light);
    const double bound = std::pow(error.tau, 3) / 2;
    ASSERT_LE(error.largest, bound) << "triangle " << i << ", tau " << error.tau;
    largest_ratio = std::max(largest_ratio, error.largest / bound);
  }
  EXPECT_GT(largest_ratio, 0.9) << "the bound is loose: the cases are too tame to test it";
}

TEST(TaylorError, GrowsVisiblyWithTheSpreadOfTheNormals) {
  constexpr unsigned kSeed = 4;
  SCOPED_TRACE(kSeed);
  const auto median = [](double spread) {
    RandomTriangles random(kSeed);  // the same triangles and lights, spread more or less
    std::vector<double> errors;
    for (int i = 0; i < 401; ++i) {
      const auto normals = random.normals(spread * kDegrees);
      errors.push_back(diffuse_error(normals, random.unit()).largest);
    }
    std::nth_element(errors.begin(), errors.begin() + 200, errors.end());
    return errors[200] / kLsb;
  };
  const double at20 = median(20), at30 = median(30), at60 = median(60), at75 = median(75);
  EXPECT_LT(at20, 1) << "20 degrees are not seen";
  EXPECT_GT(at60, 10) << "60 degrees are tens of LSB";
  EXPECT_GT(at75, at60);
  // Third order: 27 times from 20 to 60 degrees, and more, as the chord shortens C.
  EXPECT_GT(at60 / at20, 27);
  EXPECT_GT(at30 / at20, 3.375);
}

}  // namespace
}  // namespace phongpipe
