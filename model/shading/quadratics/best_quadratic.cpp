#include "model/shading/quadratics/best_quadratic.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace phongpipe {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Values of the quadratics that are 1 at one of the six points and 0 at the others.
Vector6 shapes(double u, double v) {
  const double w = 1 - u - v;
  Vector6 result;
  result << w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * u * v, 4 * v * w, 4 * w * u;
  return result;
}

}  // namespace

BestQuadratic best_quadratic(const std::vector<WeightedSample>& samples, int iterations) {
  constexpr double kRoundOff = 1e-13;
  std::vector<Vector6> at;
  at.reserve(samples.size());
  double largest_weight = 0;
  for (const WeightedSample& s : samples) {
    at.push_back(shapes(s.u, s.v));
    largest_weight = std::max(largest_weight, s.weight);
  }
  std::vector<double> share(samples.size(), 1.0 / static_cast<double>(samples.size()));
  std::vector<double> missed(samples.size());
  BestQuadratic best = {{}, -1, 0};
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double weight = share[i] * samples[i].weight * samples[i].weight;
      normal += weight * at[i] * at[i].transpose();
      right += weight * samples[i].value * at[i];
    }
    const Vector6 q = normal.ldlt().solve(right);
    double largest = 0, mean_square = 0, total = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      missed[i] = samples[i].weight * std::fabs(samples[i].value - q.dot(at[i]));
      largest = std::max(largest, missed[i]);
      mean_square += share[i] * missed[i] * missed[i];
    }
    // A weighted mean is at most the maximum, of any quadratic; least squares makes it smallest.
    best.lower_bound = std::max(best.lower_bound, std::sqrt(mean_square));
    if (best.error < 0 || largest < best.error) {
      best.error = largest;
      best.values = {{q[0], q[1], q[2]}, {q[3], q[4], q[5]}};
    }
    if (largest <= kRoundOff * largest_weight) break;
    for (std::size_t i = 0; i < samples.size(); ++i) total += share[i] *= missed[i];
    for (double& s : share) s /= total;
  }
  return best;
}

}  // namespace phongpipe
