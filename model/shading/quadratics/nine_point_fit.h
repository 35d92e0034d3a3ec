// Fits a quadratic to values at nine points (corners C, midpoints M and inner points I) by one
// linear map for all triangles. Nine values deviate from a quadratic in two ways: in ΣI − ΣM, and
// in the differences between the three numbers M − C + 3I, one for each line from a corner to the
// opposite edge. Every map that treats the corners alike and returns quadratics unchanged adds
// multiples of these deviations.
#pragma once

#include "model/shading/quadratics/cosine_samples.h"

namespace phongpipe {

// Chosen for the smallest largest error of cosines, relative to that of the best quadratics.
struct NinePointMap {
  double corner_line = 0.275, middle_line = 0.0675;
  double corner_sum = 0.142, middle_sum = 0.222;
};

template <typename T>
SixValues<T> fit_nine_points(const Values<T, kNinePoints>& f) {
  constexpr NinePointMap kMap;
  std::array<T, 3> line;
  for (std::size_t k = 0; k < 3; ++k) line[k] = f[3 + k] - f[k] + (twice(f[6 + k]) + f[6 + k]);
  const T mean = (line[0] + line[1] + line[2]) * T(1.0 / 3);
  const T sum = f[6] + f[7] + f[8] - (f[3] + f[4] + f[5]);
  const T corners = sum * T(kMap.corner_sum), middles = sum * T(kMap.middle_sum);
  SixValues<T> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const T differs = line[k] - mean;
    result.corner[k] = f[k] + (corners + differs * T(kMap.corner_line));
    result.middle[k] = f[3 + k] + (middles - differs * T(kMap.middle_line));
  }
  return result;
}

}  // namespace phongpipe
