// Random triangles as NUMERICS has them: three normals on a cone, and a light or a halfway vector.
// Cosines depend on barycentric coordinates only, so that the triangle's shape on the screen does
// not matter.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/shading/quadratics/best_quadratic.h"
#include "model/shading/quadratics/cosine_series.h"
#include "testbench/tests/model/shading/random_normals.h"

namespace phongpipe {

struct CosineCase {
  std::array<Vec, 3> normal;
  Vec m;
  double power;

  double cosine(double u, double v) const {
    const Vec n = normal[0] * (1 - u - v) + normal[1] * u + normal[2] * v;
    return n.dot(m) / n.norm();
  }
};

class RandomCases : public RandomNormals {
 public:
  using RandomNormals::RandomNormals;

  // `spread`: across the cone, in degrees.
  std::array<Vec, 3> normals(double spread) { return cone(spread / 2 * kDegrees, 360 * kDegrees); }
  // Lit at all corners.
  CosineCase diffuse(double spread) {
    for (;;) {
      const CosineCase c = {normals(spread), unit(), 1};
      if (c.cosine(0, 0) > 0 && c.cosine(1, 0) > 0 && c.cosine(0, 1) > 0) return c;
    }
  }
  // The highlight's middle lies inside.
  CosineCase specular(double spread, double power) {
    const std::array<Vec, 3> n = normals(spread);
    double u = uniform(0, 1), v = uniform(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return {n, (n[0] * (1 - u - v) + n[1] * u + n[2] * v).normalized(), power};
  }
};

// A triangle whose x and y, from the centroid, are u − ⅓ and v − ⅓.
template <typename T>
Interpolator<T> unit_triangle() {
  const T near(-1.0 / 3), far(2.0 / 3);
  return Interpolator<T>({near, far, near}, {near, near, far});
}

inline double displayed(double cosine, double power) {
  const double clamped = std::min(1.0, std::max(0.0, cosine));
  return 255 * (power == 1 ? clamped : std::pow(clamped, power));
}

// Largest error in LSB of a quadratic in u − ⅓ and v − ⅓.
inline double largest_error(const CosineCase& c, const Quadratic<double>& q, int steps = 40) {
  double largest = 0;
  for (const CosineSample& s :
       dense_samples(steps, [&c](double u, double v) { return c.cosine(u, v); })) {
    const double fitted = q(s.u - 1.0 / 3, s.v - 1.0 / 3);
    const double error = displayed(fitted, c.power) - displayed(s.cosine, c.power);
    largest = std::max(largest, std::fabs(error));
  }
  return largest;
}

// The series of the case's vector, as a light's for power 1, else as a highlight's.
inline Quadratic<double> fitted(SeriesFit fit, const CosineCase& c) {
  const CosineSeries<double> series =
      fit_series(fit, unit_triangle<double>(), c.normal, c.m, c.m, c.power - 1);
  return c.power == 1 ? series.light : series.highlight;
}

inline Quadratic<double> best(const CosineCase& c, int steps = 40) {
  const auto cosine = [&c](double u, double v) { return c.cosine(u, v); };
  const Interpolator<double> triangle = unit_triangle<double>();
  const BarycentricBasis<double> basis(triangle.coordinate_1(), triangle.coordinate_2());
  return basis(best_quadratic(dense_samples(steps, cosine), c.power).values);
}

struct Spread {
  double median, worst;
};

inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.back()};
}

}  // namespace phongpipe
