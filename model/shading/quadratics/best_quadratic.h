// The limit for six numbers a triangle. Too slow for a setup engine; for comparing fits with.
#pragma once

#include <vector>

#include "model/shading/quadratics/barycentric.h"

namespace phongpipe {

struct CosineSample {
  double u, v;  // barycentric coordinates of corners 1 and 2
  double cosine;
};

// Errors are those of the displayed power, max(0, cosine)^power up to 1, full scale 1.
struct BestQuadratic {
  SixValues<double> values;
  double error;        // largest over the samples
  double lower_bound;  // no quadratic has a smaller one
};

// An error of the power allows the cosine a band, so that each bisection of the error asks whether
// a quadratic stays within bands: minimax, weighted by what the power minds. Until the error is
// within 2 % of the limit or at most `good_enough`.
BestQuadratic best_quadratic(const std::vector<CosineSample>& samples, double power,
                             double good_enough = 0);

// At even distances, `steps` to an edge: the cosine by `cosine(u, v)`.
template <typename Cosine>
std::vector<CosineSample> dense_samples(int steps, const Cosine& cosine) {
  std::vector<CosineSample> samples;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      samples.push_back({u, v, cosine(u, v)});
    }
  }
  return samples;
}

}  // namespace phongpipe
