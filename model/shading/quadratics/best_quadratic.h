// The limit for six numbers a triangle: weighted minimax. Too slow for a setup engine; for
// comparing fits with.
#pragma once

#include <cmath>
#include <vector>

#include "model/shading/quadratics/barycentric.h"

namespace phongpipe {

// A value at a point of the triangle, with the weight of an error there.
struct WeightedSample {
  double u, v;  // barycentric coordinates of corners 1 and 2
  double value;
  double weight;
};

struct BestQuadratic {
  SixValues<double> values;
  double error;        // largest weighted one over the samples
  double lower_bound;  // no quadratic has a smaller one
};

// By Lawson's iteration: least squares again and again, samples gaining weight with their error.
BestQuadratic best_quadratic(const std::vector<WeightedSample>& samples, int iterations = 100);

// At even distances, `steps` to an edge: the cosine by `cosine(u, v)`, weighed by the sensitivity
// of its power, 1 for power 1.
template <typename Cosine>
std::vector<WeightedSample> dense_samples(int steps, double power, const Cosine& cosine) {
  std::vector<WeightedSample> samples;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      const double s = cosine(u, v);
      // An error that is not seen may not run away either: a highlight must not come back.
      constexpr double kLeastCosine = 1e-3, kLeastWeight = 1e-6;
      const double weight =
          power == 1 ? 1 : std::pow(s > kLeastCosine ? s : kLeastCosine, power - 1) + kLeastWeight;
      samples.push_back({u, v, s, weight});
    }
  }
  return samples;
}

}  // namespace phongpipe
