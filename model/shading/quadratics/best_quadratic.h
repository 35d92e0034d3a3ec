// The best quadratic over a triangle: the limit of what six coefficients can do. Too slow for a
// setup engine; it serves for comparison with the fits.
#pragma once

#include <vector>

#include "model/shading/quadratics/barycentric.h"

namespace phongpipe {

struct CosineSample {
  double u, v;  // barycentric coordinates of corners 1 and 2
  double cosine;
};

// Errors are those of the displayed power max(0, cosine)^power, clamped to 1; full scale is 1.
struct BestQuadratic {
  SixValues<double> values;
  double error;        // largest over the samples
  double lower_bound;  // no quadratic has a smaller error
};

// Weighted minimax fit, by bisection of the error. A given error of the power allows each cosine a
// band; each step decides whether a quadratic lies within all bands. Stops when the error is within
// 2 % of the limit or at most `good_enough`.
BestQuadratic best_quadratic(const std::vector<CosineSample>& samples, double power,
                             double good_enough = 0);

// Samples of `cosine(u, v)` at equal distances, `steps` intervals to an edge.
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
