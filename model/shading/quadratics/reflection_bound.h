// Bounds, over a triangle, of the values and third derivatives of the two functions of a light that
// quadratics stand for: A N·L, and A^fold N·H or A^fold R·V. See derivative_bounds.h.
#pragma once

#include <optional>

#include "model/shading/quadratics/derivative_bounds.h"
#include "model/shading/quadratics/reflection_series.h"

namespace phongpipe {

// A third derivative that is at least so large says that nothing is proved.
constexpr double kNoBound = 1e6;

// Of one of the functions.
template <typename T>
struct ReflectionBound {
  T low{}, high{};  // its values
  T third{};        // its third derivative
  T cancelled{};    // how many times more its arithmetic loses, where light and eye are opposed
};

// A vector that is linear between the corners.
template <typename T>
struct VectorExtent {
  T inverse_least{};   // at least 1/|V|
  T turn{}, turn_2{};  // largest derivative of the direction, and its square
  // Largest |V·V'|/|V|²: by how much the length changes, in units of itself.
  T stretch{};
  std::array<T, 3> inverse_corner{};  // 1/|V| at the corners
  DerivativeBounds<T> vector;

  explicit VectorExtent(const Corners<T>& v) {
    constexpr double kTiny = 1e-30;  // keeps rsqrt finite
    const auto most = [](const std::array<T, 3>& x) { return maximum(x[0], maximum(x[1], x[2])); };
    const auto least = [](const std::array<T, 3>& x) { return at_most(x[0], at_most(x[1], x[2])); };
    std::array<T, 3> square, product, change;  // of corner i; of corners j and k; of edge jk
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3<T>&j = v[(i + 1) % 3], &k = v[(i + 2) % 3];
      const Vector3<T> edge = k - j;
      square[i] = v[i].dot(v[i]);
      product[i] = j.dot(k);
      change[i] = edge.dot(edge);
      inverse_corner[i] = rsqrt(maximum(square[i], T(kTiny)));
    }
    // |V|² is a quadratic form of the barycentric coordinates, whose coefficients bound it.
    const T least_square = maximum(at_most(least(square), least(product)), T(kTiny));
    inverse_least = rsqrt(least_square);
    const T inverse_square = inverse_least * inverse_least;
    const T largest_change = maximum(most(change), T(kTiny));
    const T largest = most(square);
    vector = {largest * rsqrt(maximum(largest, T(kTiny))), largest_change * rsqrt(largest_change),
              T(0), T(0)};
    turn = vector.first * inverse_least;
    turn_2 = turn * turn;
    // V·V' along an edge is linear, too: it is largest at a corner.
    T along{};
    const auto include = [&](const T& a) { along = maximum(along, maximum(a, -a)); };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      include(product[i] - square[j]);
      include(product[i] - square[k]);
      include(product[k] - product[j]);
    }
    stretch = along * inverse_square;
  }

  DerivativeBounds<T> unit() const { return direction(vector, inverse_least); }
};

namespace detail {

template <typename T>
ReflectionBound<T> bound_from_corners(const std::array<T, 3>& f, const T& second, const T& third) {
  const T off = second * T(kLinearError);
  return {at_most(f[0], at_most(f[1], f[2])) - off, maximum(f[0], maximum(f[1], f[2])) + off, third,
          T(0)};
}

// Of f = N·M/|N| for a constant unit M. With β = N·N'/|N|², g the length of (N/|N|)', θ the angle
// between N and M, and σ = M·(N/|N|)', which is at most g sin θ for the derivative is across N,
//   |f''| = |f g² + 2βσ|,   |f'''| = |6f β g² + 3σ (2β² − g²)|:
// near the middle of a highlight, where the sine is small, it is nearly flat.
template <typename T>
ReflectionBound<T> bound_of_cosine(const Corners<T>& normal, const VectorExtent<T>& extent,
                                   const Vector3<T>& m) {
  constexpr double kTiny = 1e-30;
  std::array<T, 3> f;
  for (std::size_t i = 0; i < 3; ++i) f[i] = normal[i].dot(m) * extent.inverse_corner[i];
  const T bending = twice(extent.stretch * extent.turn);
  ReflectionBound<T> bound = bound_from_corners(f, extent.turn_2 + bending, T(0));
  bound.low = maximum(bound.low, T(-1));
  bound.high = at_most(T(1), bound.high);
  const T least = maximum(T(0), maximum(bound.low, -bound.high));  // of |f|
  const T square = maximum(T(1) - least * least, T(kTiny));
  const T sine = square * rsqrt(square);
  bound.third =
      (extent.stretch * extent.turn_2) * T(6) +
      (sine * extent.turn) * T(3) * (extent.turn_2 + twice(extent.stretch * extent.stretch));
  return bound;
}

// The same as derivatives, for the products of R·V.
template <typename T>
DerivativeBounds<T> derivatives_of_cosine(const VectorExtent<T>& extent) {
  const T stretch_2 = extent.stretch * extent.stretch;
  return {T(1), extent.turn, extent.turn_2 + twice(extent.stretch * extent.turn),
          (extent.stretch * extent.turn_2) * T(6) +
              extent.turn * (extent.turn_2 + twice(stretch_2)) * T(3)};
}

// A light or a viewer at a finite distance: everything by the rules of derivative_bounds.h.
template <typename T>
Reflected<ReflectionBound<T>> bound_general(const ReflectionForm& form,
                                            const ReflectionTerms<T>& terms,
                                            const Corners<T>& normal, const Corners<T>& eye,
                                            const Corners<T>& light) {
  // What is too large by the least bit has no bound; an ulp of attenuation is not that.
  constexpr double kTiny = 1e-30, kNone = 1e30, kUlps = 1e-9;
  T cancelled(0);
  const auto constant = [] { return DerivativeBounds<T>{T(1), T(0), T(0), T(0)}; };
  const DerivativeBounds<T> n = VectorExtent<T>(normal).unit();
  std::optional<VectorExtent<T>> light_extent;
  if (form.point_light) light_extent.emplace(light);
  const DerivativeBounds<T> l = form.point_light ? light_extent->unit() : constant();
  const DerivativeBounds<T> e = form.local_viewer ? VectorExtent<T>(eye).unit() : constant();
  DerivativeBounds<T> f_light = n * l;
  const DerivativeBounds<T> light_eye = l * e;
  std::array<Reflected<T>, 3> corner;
  std::array<T, 3> of_light, of_highlight, between;
  for (std::size_t i = 0; i < 3; ++i) {
    const PointVectors<T> at = {normal[i], form.point_light ? light[i] : terms.to_light,
                                form.local_viewer ? eye[i] : terms.eye};
    const ReflectionCosines<T> cosines = cosines_at(form, terms, at);
    const Reflected<T> value = reflected(form, {true, true}, terms, cosines);
    of_light[i] = value.light;
    of_highlight[i] = value.highlight;
    between[i] = cosines.light_eye;
  }
  DerivativeBounds<T> f_highlight;
  if (form.highlight == Highlight::halfway) {
    // |L + E|² = 2 (1 + L·E)
    const T least = bound_from_corners(between, light_eye.second, T(0)).low;
    const T square = twice(T(1) + least);
    f_highlight = n * direction(l + e, rsqrt(maximum(square, T(kTiny))));
    cancelled = reciprocal(maximum(square, T(kTiny))) * T(4);
    // reflected() shortens vectors that are nearly opposed.
    f_highlight.third += maximum(T(0), T(2 * kLeastHalfway) - square) * T(kNone);
  } else {
    f_highlight = scaled(f_light * (n * e), T(2)) + light_eye;
  }
  T beyond(0);  // positive where attenuation exceeds its reference, and highlights saturate
  if (form.attenuated || form.spot_factor) {
    DerivativeBounds<T> a = constant();
    T low(1), high(1);
    if (form.attenuated) {
      const T &c = terms.attenuation[0], &linear = terms.attenuation[1], &q = terms.attenuation[2];
      const DerivativeBounds<T> distance =
          length(light_extent->vector, light_extent->inverse_least);
      const T nearest = reciprocal(light_extent->inverse_least), farthest = distance.value;
      const auto denominator = [&](const T& d) { return (d * q + linear) * d + c; };
      DerivativeBounds<T> sum = scaled(distance * distance, q) + scaled(distance, linear);
      sum.value = sum.value + c;
      high = reciprocal(maximum(denominator(nearest), T(kTiny)));
      low = reciprocal(maximum(denominator(farthest), T(kTiny)));
      a = inverted(sum, high);
    }
    if (form.spot_factor) {
      std::array<T, 3> spot;
      for (std::size_t i = 0; i < 3; ++i) {
        spot[i] = light[i].dot(terms.spot_axis) * light_extent->inverse_corner[i];
      }
      const ReflectionBound<T> range = bound_from_corners(spot, l.second, T(0));
      const T most = at_most(T(1), range.high);
      a = a * powered(l, terms.spot_exponent, range.low, most);
      low = low * power(range.low, terms.spot_exponent);
      high = high * power(most, terms.spot_exponent);
    }
    beyond = maximum(T(0), high - T(1 + kUlps));
    f_light = f_light * a;
    f_highlight = f_highlight * powered(a, terms.fold, low, high);
  }
  // Lights fade to more than the reference at most kLargestAttenuation times.
  Reflected<ReflectionBound<T>> bound;
  bound.light = bound_from_corners(of_light, f_light.second, f_light.third);
  bound.light.third += maximum(T(0), beyond - T(kLargestAttenuation - 1)) * T(kNone);
  bound.highlight = bound_from_corners(of_highlight, f_highlight.second, f_highlight.third);
  bound.highlight.third += beyond * T(kNone);
  bound.highlight.cancelled = cancelled;
  return bound;
}

}  // namespace detail

// Of both functions, whatever form.wanted says. Parameters are those of reflection_series().
template <typename T>
Reflected<ReflectionBound<T>> bound_reflection(const ReflectionForm& form,
                                               const ReflectionTerms<T>& terms,
                                               const Corners<T>& normal, const Corners<T>& eye,
                                               const Corners<T>& light) {
  if (form.point_light || form.local_viewer) {
    return detail::bound_general(form, terms, normal, eye, light);
  }
  const VectorExtent<T> extent(normal);
  Reflected<ReflectionBound<T>> bound;
  bound.light = detail::bound_of_cosine(normal, extent, terms.to_light);
  if (form.highlight == Highlight::halfway) {
    bound.highlight = detail::bound_of_cosine(normal, extent, terms.halfway);
    return bound;
  }
  const DerivativeBounds<T> cosine = detail::derivatives_of_cosine(extent);
  const DerivativeBounds<T> product = scaled(cosine * cosine, T(2));
  std::array<T, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    const PointVectors<T> at = {normal[i], terms.to_light, terms.eye};
    corner[i] = reflected(form, {false, true}, terms, cosines_at(form, terms, at)).highlight;
  }
  bound.highlight = detail::bound_from_corners(corner, product.second, product.third);
  return bound;
}

// What makes LSB of the errors of series.
template <typename T>
struct ErrorScales {
  T diffuse{}, specular{};  // LSB of 1 of the light's function, and of a full highlight
  T shininess{};            // at least 1
  T noise{};                // of the arithmetic of both series, in cosines
  T light_rounding{}, highlight_rounding{};  // of their registers; in LSB, and in cosines
};

// Largest errors of a light's two series and of what is shown of them.
template <typename T>
struct QuadraticErrors {
  T light{};      // of the diffuse term, in LSB
  T base{};       // of the series of the highlight, which is the base of its power
  T highlight{};  // of the power, in LSB
};

// `light_error`, `highlight_error`: kSixPointError or taylor_error().
template <typename T>
QuadraticErrors<T> quadratic_errors(const Reflected<ReflectionBound<T>>& bound,
                                    const ErrorScales<T>& scales, const T& light_error,
                                    const T& highlight_error) {
  QuadraticErrors<T> errors;
  errors.light =
      (bound.light.third * light_error + scales.noise) * scales.diffuse + scales.light_rounding;
  errors.base = bound.highlight.third * highlight_error +
                scales.noise * (T(1) + bound.highlight.cancelled) + scales.highlight_rounding;
  const T most = at_most(T(1), maximum(T(0), bound.highlight.high + errors.base));
  errors.highlight =
      scales.shininess * power(most, scales.shininess - T(1)) * (errors.base * scales.specular);
  return errors;
}

}  // namespace phongpipe
