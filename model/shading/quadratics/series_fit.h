// Which six numbers a triangle's T_i are. The pixel hardware is the same for all.
#pragma once

#include <string_view>
#include <vector>

namespace phongpipe {

enum class SeriesFit {
  taylor,     // the paper's series about the expansion point
  six_point,  // through the corners and the middles of the edges
  weighted,   // least squares over ten points, specular ones by the sensitivity of the power
  focused     // the same; the specular ten points close in on the highlight
};

// By the enumeration's order.
inline std::vector<std::string_view> series_fit_names() {
  return {"taylor", "six-point", "weighted", "focused"};
}

}  // namespace phongpipe
