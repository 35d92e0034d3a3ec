// Bounds of the series of N·M over a triangle, computed before its setup.
//
// Along any line N(t) in a triangle, |d³/dt³ N·M/|N|| ≤ 3 (|N'|/|N|)³ for a constant unit M. Proof:
// let h be the least distance of the line from the origin, and u the distance from the nearest
// point, in units of h. The components of N/|N| are 1/√(1 + u²) and u/√(1 + u²), and their third
// derivatives have the length 3 √(4u⁶ + 4u⁴ + u² + 1) / (1 + u²)^(7/2) ≤ 3 / (1 + u²)^(3/2). So the
// error of a second-degree Taylor series T of f about a point of the triangle is at most τ³/2, with
// τ = (largest distance from the normal at the point to that at a corner) / (length of the shortest
// normal). A fit P returns quadratics unchanged, so for any such point its error is at most
//   |f − T| + |P(f − T)| ≤ (1 + ‖P‖) τ³/2.
#pragma once

#include "model/shading/quadratics/cosine_samples.h"
#include "model/shading/quadratics/truncated_series.h"

namespace phongpipe {

// Extent of a vector field that is linear over a triangle.
template <typename T>
struct FieldExtent {
  T inverse_shortest, inverse_longest;  // bounds of 1/|N| over the triangle
  T turn;                               // τ about the best of the edges' midpoints

  // `form`: |N|²; its Bernstein coefficients bound it.
  explicit FieldExtent(const QuadraticForm<T>& form) {
    constexpr double kTiny = 1e-30;  // keeps rsqrt finite if there is no bound, or no turn
    const auto least = [](const std::array<T, 3>& v) { return at_most(v[0], at_most(v[1], v[2])); };
    const auto most = [](const std::array<T, 3>& v) { return maximum(v[0], maximum(v[1], v[2])); };
    const auto& [square, cross] = form;
    const T shortest = at_most(half(least(cross)), least(square));
    inverse_shortest = rsqrt(maximum(shortest, T(kTiny)));
    inverse_longest = rsqrt(most(square));
    // Squared distances between the corners' vectors, and from the edges' midpoints to the farthest
    // corner.
    std::array<T, 3> edge, from_middle;
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = square[(k + 1) % 3] + square[(k + 2) % 3] - cross[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const T quarter = half(half(edge[k]));
      from_middle[k] = maximum(quarter, half(edge[(k + 1) % 3] + edge[(k + 2) % 3]) - quarter);
    }
    const T way = maximum(least(from_middle), T(kTiny));
    turn = way * rsqrt(way) * inverse_shortest;
  }
};

// Bounds of the cosine N·M/(|N||M|), from those of N·M.
template <typename T>
struct CosineRange {
  T low, high;

  CosineRange(const T& lowest_product, const T& highest_product, const T& inverse_shortest,
              const T& inverse_longest)
      : low(at_most(lowest_product * inverse_shortest, lowest_product * inverse_longest)),
        high(at_most(
            T(1), maximum(highest_product * inverse_shortest, highest_product * inverse_longest))) {
  }
};

// Bounds of N·M/|N| for a constant unit M.
template <typename T>
CosineRange<T> cosine_range(const std::array<Vector3<T>, 3>& normal, const FieldExtent<T>& extent,
                            const Vector3<T>& m) {
  const T a = normal[0].dot(m), b = normal[1].dot(m), c = normal[2].dot(m);
  return {at_most(a, at_most(b, c)), maximum(a, maximum(b, c)), extent.inverse_shortest,
          extent.inverse_longest};
}

// Largest error of the Taylor series about a point of the triangle: τ³/2.
template <typename T>
T taylor_remainder(const T& turn) {
  return half(turn * turn * turn);
}

// ‖P‖: the largest sum of the absolute values of a fit's basis functions in the triangle.
constexpr double kSixPointNorm = 5.0 / 3;
constexpr double kNinePointNorm = 2.4667;

// Bounds of a series, fitted with the given norm, whose exact cosine lies within `range`.
template <typename T>
struct SeriesRange {
  T low{}, high{};
};
template <typename T>
SeriesRange<T> series_range(const CosineRange<T>& range, const T& remainder, double norm) {
  const T off = remainder * T(1 + norm);
  return {range.low - off, range.high + off};
}

}  // namespace phongpipe
