// What the series of N·M can reach on a triangle at most, known before it is set up.
//
// Along any line N(t) in a triangle, |d³/dt³ N·M/|N|| ≤ 3 (|N'|/|N|)³ for a constant unit M: with N
// h from the origin at its nearest and u the way from there in units of h, the components of N/|N|
// are 1/√(1 + u²) and u/√(1 + u²), and the length of their third derivatives is
// 3 √(4u⁶ + 4u⁴ + u² + 1) / (1 + u²)^(7/2) ≤ 3 / (1 + u²)^(3/2). So a second-degree Taylor series
// about a point of the triangle is off by τ³/2 at most, τ = (longest way from its normal to a
// corner's) / (shortest normal). A fit P returns quadratics unchanged, so that it is off by |f − T|
// + |P(f − T)| ≤ (1 + ‖P‖) τ³/2, whatever the point.
#pragma once

#include "model/shading/quadratics/cosine_samples.h"
#include "model/shading/quadratics/truncated_series.h"

namespace phongpipe {

// The extent of a vector field that is linear over a triangle.
template <typename T>
struct FieldExtent {
  T inverse_shortest, inverse_longest;  // 1/|N|, bounds over the triangle
  T turn;  // the longest way from some point of the triangle to a corner, over the shortest |N|

  // `form`: |N|², whose Bernstein coefficients bound it.
  explicit FieldExtent(const QuadraticForm<T>& form) {
    constexpr double kTiny = 1e-30;  // for rsqrt, where there is no bound or nothing turns
    const auto least = [](const std::array<T, 3>& v) { return at_most(v[0], at_most(v[1], v[2])); };
    const auto most = [](const std::array<T, 3>& v) { return maximum(v[0], maximum(v[1], v[2])); };
    const auto& [square, cross] = form;
    const T shortest = at_most(half(least(cross)), least(square));
    inverse_shortest = rsqrt(maximum(shortest, T(kTiny)));
    inverse_longest = rsqrt(most(square));
    // Squares of the edges between the values, and of the ways from their middles to the corners.
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

// Bounds on the cosine N·M/(|N||M|) itself, from those of N·M.
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

// For a constant M of unit length.
template <typename T>
CosineRange<T> cosine_range(const std::array<Vector3<T>, 3>& normal, const FieldExtent<T>& extent,
                            const Vector3<T>& m) {
  const T a = normal[0].dot(m), b = normal[1].dot(m), c = normal[2].dot(m);
  return {at_most(a, at_most(b, c)), maximum(a, maximum(b, c)), extent.inverse_shortest,
          extent.inverse_longest};
}

// How far the Taylor series about a point of the triangle may be off.
template <typename T>
T taylor_remainder(const T& turn) {
  return half(turn * turn * turn);
}

// ‖P‖: the largest sum of the absolute values of a fit's basis functions in the triangle.
constexpr double kSixPointNorm = 5.0 / 3;
constexpr double kNinePointNorm = 2.4667;

// The lowest and highest values a series by a fit of this norm can have, where the cosine is
// `range`.
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
