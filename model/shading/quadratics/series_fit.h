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

// By the enumeration's order.
inline std::vector<std::string_view> series_fit_names() {
  return {"taylor", "six-point", "weighted", "focused"};
}

}  // namespace phongpipe
