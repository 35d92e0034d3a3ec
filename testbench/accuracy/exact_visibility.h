// Pixels at which the frame shows another triangle than exact depths do: where stored depths are
// too coarse to tell which triangle is nearer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "model/fixed/model_frame.h"

namespace phongpipe {

// A depth in double precision and a bound of its rounding error.
struct BoundedDepth {
  double z = 0, rounding = 0;

  bool is_nearer_than(const BoundedDepth& other) const {
    return z < other.z - std::max(rounding, other.rounding);
  }
};

// Depth of a triangle at the centres of its pixels: a mean of the vertices' depths with exact
// weights, so that it is off by a few units in the last place of the largest of them.
class ExactDepth {
 public:
  explicit ExactDepth(const ScreenTriangle& triangle);

  BoundedDepth at(int x, int y) const;

 private:
  // Twice the area of the triangle of a pixel's centre and two vertices, divided by the whole.
  struct Weight {
    std::int64_t a, b, c;  // a·x + b·y + c, in subpixels
    double z;              // of the third vertex
  };
  std::array<Weight, 3> weights_;
  double doubled_area_, rounding_;
};

struct MisplacedPixel {
  std::size_t index = 0;       // of the pixel, row by row from the top
  std::uint32_t triangle = 0;  // the nearest one, or the earliest of several
};

// All of the frame, by index. Uses all cores or one; the result is the same.
std::vector<MisplacedPixel> misplaced_pixels(const FrameSetup& frame, const ModelFrame& model,
                                             bool one_core);

}  // namespace phongpipe
