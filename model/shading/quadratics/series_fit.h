// Which six numbers a triangle's T_i are. The pixel hardware is the same for all.
#pragma once

#include <array>
#include <string_view>

namespace phongpipe {

enum class SeriesFit {
  taylor,     // the paper's series about the expansion point
  six_point,  // through the corners and the middles of the edges
  weighted    // least squares over ten points, specular ones by the sensitivity of the power
};

constexpr std::array<std::string_view, 3> kSeriesFitNames = {"taylor", "six-point", "weighted"};

}  // namespace phongpipe
