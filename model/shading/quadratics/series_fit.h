// Which six numbers a triangle's T_i are. The pixel hardware is the same for all.
#pragma once

#include <string_view>
#include <vector>

namespace phongpipe {

enum class SeriesFit {
  taylor,     // the paper's series about the expansion point
  six_point,  // through the corners and the middles of the edges
  weighted,   // near ten points: N·L evenly, N·H by the sensitivity of its power
  focused     // the same, with the points of N·H closing in on the highlight
};

// What a light's two series are of, and of what they are made at a point.
template <typename F>
struct Reflected {
  F light{}, highlight{};
};

// Which of the two are needed; no operation of the other is executed.
struct SeriesWanted {
  bool light = true, highlight = true;
};
inline bool operator==(const SeriesWanted& a, const SeriesWanted& b) {
  return a.light == b.light && a.highlight == b.highlight;
}

// By the enumeration's order.
inline std::vector<std::string_view> series_fit_names() {
  return {"taylor", "six-point", "weighted", "focused"};
}

}  // namespace phongpipe
