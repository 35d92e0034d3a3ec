// The triangle seen at each pixel, with the coverage of the pipeline and depths in double
// precision. All pictures in real arithmetic are drawn by it, whatever the method.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fixed/coverage.h"

namespace phongpipe {

struct Visibility {
  static constexpr std::uint32_t kNothing = ~std::uint32_t{0};

  int width = 0, height = 0;
  std::vector<std::uint32_t> seen;         // triangle of each pixel of the image, or kNothing
  std::vector<std::vector<RowSpan>> rows;  // of each triangle: all its pixels, seen or hidden
  std::size_t spans = 0, shaded = 0, triangles = 0;  // rows, their pixels, triangles with any pixel

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

Visibility find_visible(const Scene& scene, const Geometry& geometry);

}  // namespace phongpipe
