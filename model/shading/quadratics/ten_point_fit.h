// Fits a quadratic to values at ten points by weighted least squares, in closed form. The points
// lie at equal distances, four on each line from a corner to the opposite edge. With values C at
// corners, M at midpoints, I at inner points and G at the centroid, quadratics satisfy −C + 3I −
// 3G + M = 0 on each line and Σ4M − ΣC − 9G = 0. The least-squares residual is a combination of
// these four differences, with the part of each value divided by its weight. So there are four
// unknowns instead of six, nearly decoupled.
#pragma once

#include "model/shading/quadratics/cosine_samples.h"

namespace phongpipe {

// 1/x by rsqrt, because the setup engine has no divider.
template <typename T>
T reciprocal(const T& positive) {
  const T root = rsqrt(positive);
  return root * root;
}

template <typename T>
T thrice(const T& x) {
  return twice(x) + x;
}

// The four differences that vanish for quadratics.
template <typename T>
struct Differences {
  std::array<T, 3> line;
  T around;

  explicit Differences(const Values<T, kTenPoints>& f) {
    const T centre = thrice(f[9]);
    around = twice(twice(f[3] + f[4] + f[5])) - (f[0] + f[1] + f[2]) - thrice(centre);
    for (std::size_t k = 0; k < 3; ++k) line[k] = f[3 + k] - f[k] + (thrice(f[6 + k]) - centre);
  }
};

// `spread`: 1/weight of each squared residual, positive; their common scale does not matter.
template <typename T>
SixValues<T> fit_ten_points(const Values<T, kTenPoints>& f, const Values<T, kTenPoints>& spread) {
  const Differences<T> b(f);
  // Per line k an unknown y[k], for all of them z: d[k] y[k] + 3 g + e[k] z = b.line[k] and
  // Σ e y + 9 g + h z = b.around, where −g is the residual at the centroid.
  std::array<T, 3> e, b_over_d, e_over_d, inverse;
  T q = T(-3), h = b.around;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = spread[k] + twice(twice(spread[3 + k]));
    inverse[k] = reciprocal(spread[k] + spread[6 + k] * T(9) + spread[3 + k]);
    b_over_d[k] = b.line[k] * inverse[k];
    e_over_d[k] = e[k] * inverse[k];
    q += e_over_d[k];
    h -= e[k] * b_over_d[k];
  }
  const T corners = spread[0] + spread[1] + spread[2], middles = spread[3] + spread[4] + spread[5];
  const T t = corners + twice(twice(twice(twice(middles)))) -
              (e[0] * e_over_d[0] + e[1] * e_over_d[1] + e[2] * e_over_d[2]);
  // With S the spread at the centroid: p g + S q z = β and −3 q g + t z = h.
  const T p = T(1.0 / 3) + thrice(spread[9] * (inverse[0] + inverse[1] + inverse[2]));
  const T r = spread[9] * q;
  const T beta = spread[9] * (b_over_d[0] + b_over_d[1] + b_over_d[2]);
  const T inverse_det = reciprocal(p * t + thrice(r * q));
  const T three_g = thrice((beta * t - r * h) * inverse_det);
  const T z = (p * h + thrice(beta * q)) * inverse_det;

  SixValues<T> result;
  for (std::size_t k = 0; k < 3; ++k) {
    const T y = b_over_d[k] - three_g * inverse[k] - e_over_d[k] * z;
    result.corner[k] = f[k] + spread[k] * (y + z);
    result.middle[k] = f[3 + k] - spread[3 + k] * (y + twice(twice(z)));
  }
  return result;
}

}  // namespace phongpipe
