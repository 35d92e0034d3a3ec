// Bounds of a field over a triangle and of its first three derivatives: arithmetic on them gives
// those of cosines, lengths and powers of interpolated vectors, and from these the largest errors
// of quadratics.
//
// Two points of a triangle whose barycentric coordinates differ by Δ are ‖Δ‖ = max |Δi| apart: the
// corners are at a distance of 1 from each other. A bound holds in every direction, per unit of
// that distance. Since any Δ is a sum of edges whose weights add up to ‖Δ‖, a vector field that is
// linear between the corners changes by at most ‖Δ‖ times the longest difference between two
// corners.
#pragma once

#include <array>

#include "model/shading/quadratics/sensitivity.h"
#include "model/shading/quadratics/ten_point_fit.h"
#include "model/shading/quadratics/truncated_series.h"

namespace phongpipe {

// Of a number, or of a vector's length: |f| ≤ value, |f'| ≤ first, and so on.
template <typename T>
struct DerivativeBounds {
  T value{}, first{}, second{}, third{};
};

template <typename T>
DerivativeBounds<T> operator+(const DerivativeBounds<T>& a, const DerivativeBounds<T>& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second, a.third + b.third};
}

// Of a product, or of a dot product, by Leibniz's rule.
template <typename T>
DerivativeBounds<T> operator*(const DerivativeBounds<T>& a, const DerivativeBounds<T>& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + twice(a.first * b.first) + a.value * b.second,
          a.third * b.value + (a.second * b.first + a.first * b.second) * T(3) + a.value * b.third};
}

template <typename T>
DerivativeBounds<T> scaled(const DerivativeBounds<T>& a, const T& k) {
  return {a.value * k, a.first * k, a.second * k, a.third * k};
}

// 2/√3, the largest second derivative of a direction, and third derivative of a length, see below.
constexpr double kBend = 1.1547005383792517;

// Of V/|V|. `inverse_least`: at least 1/|V| everywhere.
//
// Where V runs along a line whose least distance from the origin is h, u the way from that point in
// units of h, V/|V| has the components 1/√(1 + u²) and u/√(1 + u²). The lengths of its first three
// derivatives, in units of 1/|V|, 1/|V|² and 1/|V|³, are
//   1/√(1 + u²) ≤ 1,   √(1 + 4u²)/(1 + u²) ≤ 2/√3,   3 √(4u⁶ + 4u⁴ + u² + 1)/(1 + u²)² ≤ 3.
// These bound the derivatives of V/|V| as multilinear forms (a symmetric form over a Euclidean
// space is largest on its diagonal), and the chain rule gives those along any path.
template <typename T>
DerivativeBounds<T> direction(const DerivativeBounds<T>& v, const T& inverse_least) {
  const T first = v.first * inverse_least, second = v.second * inverse_least;
  const T square = first * first;
  return {T(1), first, second + square * T(kBend),
          v.third * inverse_least + (first * second) * T(3 * kBend) + (square * first) * T(3)};
}

// Of |V|: along the line above its derivatives are u/√(1 + u²), h²/|V|³ ≤ 1/|V| and
// −3u/(1 + u²)^(5/2)/h², at most 2/√3 /|V|².
template <typename T>
DerivativeBounds<T> length(const DerivativeBounds<T>& v, const T& inverse_least) {
  const T turn = v.first * inverse_least;
  return {v.value, v.first, v.second + v.first * turn,
          v.third + (v.second * turn) * T(3) + (v.first * turn * turn) * T(kBend)};
}

// Of φ(x), from bounds of φ and its derivatives by x.
template <typename T>
DerivativeBounds<T> composed(const DerivativeBounds<T>& phi, const DerivativeBounds<T>& x) {
  const T square = x.first * x.first;
  return {phi.value, phi.first * x.first, phi.second * square + phi.first * x.second,
          phi.third * (square * x.first) + (phi.second * (x.first * x.second)) * T(3) +
              phi.first * x.third};
}

// Of 1/x. `inverse_least`: at least 1/x everywhere.
template <typename T>
DerivativeBounds<T> inverted(const DerivativeBounds<T>& x, const T& inverse_least) {
  const T square = inverse_least * inverse_least, cube = square * inverse_least;
  return composed({inverse_least, square, twice(cube), (square * square) * T(6)}, x);
}

// Of x^p with x from `low` to `high`; without bound if `low` is not positive. The k-th derivative
// by x is p (p − 1) … x^p / x^k.
template <typename T>
DerivativeBounds<T> powered(const DerivativeBounds<T>& x, const T& p, const T& low, const T& high) {
  constexpr double kLeast = 1e-30;
  const auto size = [](const T& a) { return maximum(a, -a); };
  const T inverse = reciprocal(maximum(low, T(kLeast)));
  const T value = maximum(power(low, p), power(high, p));
  const T first = size(p) * (value * inverse);
  const T second = size(p - T(1)) * (first * inverse);
  return composed({value, first, second, size(p - T(2)) * (second * inverse)}, x);
}

// Largest difference of a field from its linear interpolation between the corners, in units of its
// second derivative: at most Σ λi (1 − λi)²/2, which is largest at the centroid.
constexpr double kLinearError = 2.0 / 9;

// Largest error of a quadratic through the corners and the midpoints of the edges, in units of the
// third derivative f'''. By Taylor's series about p, in which interpolation is exact but for the
// remainders, f(p) is off by at most Σ |ℓi(p)| ‖xi − p‖³ f'''/6, where ℓi is the quadratic that is
// 1 at node xi and 0 at the others. The sum is at most 0.21; derivative_bounds_test covers the
// triangle with cells and bounds it in each.
constexpr double kSixPointError = 0.035;

// The same of the Taylor series about a point at most `distance` from every corner, and so from
// every point: the remainder itself.
template <typename T>
T taylor_error(const T& distance) {
  return distance * distance * distance * T(1.0 / 6);
}

}  // namespace phongpipe
