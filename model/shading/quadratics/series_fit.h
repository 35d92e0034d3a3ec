// How the six coefficients T_i of a triangle are chosen. The pixel hardware is the same for all.
#pragma once

#include <string_view>
#include <vector>

#include "model/shading/fields.h"

namespace phongpipe {

enum class SeriesFit {
  taylor,     // the paper's series about the expansion point
  six_point,  // interpolates at the corners and at the midpoints of the edges
  weighted,   // N·L fitted at nine points, N·H at ten, weighted by the sensitivity of its power
  focused     // as weighted, with the points of N·H moved onto the highlight
};

// Light (N·L) and highlight (N·H or R·V) of one light: their series, or their values at a point.
template <typename F>
struct Reflected {
  F light{}, highlight{};
};

// Which of the two series are computed; no operation of the other is executed.
struct SeriesWanted {
  bool light = true, highlight = true;

  static constexpr auto fields() {
    using W = SeriesWanted;
    return std::make_tuple(field("light", &W::light), field("highlight", &W::highlight));
  }
};
inline bool operator==(const SeriesWanted& a, const SeriesWanted& b) {
  return equal_fields(a, b);
}

// In the order of SeriesFit.
inline std::vector<std::string_view> series_fit_names() {
  return {"taylor", "six-point", "weighted", "focused"};
}

}  // namespace phongpipe
