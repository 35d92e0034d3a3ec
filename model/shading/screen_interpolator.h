// Interpolation over a triangle in image coordinates: pixels from the top left corner of the image.
#pragma once

#include "model/scene/geometry.h"
#include "model/shading/linear.h"

namespace phongpipe {

inline Interpolator<double> screen_interpolator(const ScreenTriangle& triangle) {
  const auto& v = triangle.vertices;
  return {{in_pixels(v[0].x), in_pixels(v[1].x), in_pixels(v[2].x)},
          {in_pixels(v[0].y), in_pixels(v[1].y), in_pixels(v[2].y)}};
}

}  // namespace phongpipe
