// A whole frame by the bit-accurate model: the account that says what every pixel must be.
#pragma once

#include <vector>

#include "model/fixed/framebuffer.h"
#include "model/fixed/pixel_datapath.h"

namespace phongpipe {

struct TracedSpan {
  RowSpan row;
  std::uint32_t triangle = 0;
};

struct ModelFrame {
  std::vector<ShadedPixel> stream;    // every shaded pixel, in order, before the depth test
  std::vector<TracedSpan> spans;      // where they come from
  Framebuffer framebuffer;            // with owners
  std::size_t triangles_set_up = 0;   // that cover a pixel, once for every light that reaches them
  std::size_t triangles_dropped = 0;  // of them, found to add nothing to their pixels
  std::size_t coefficient_overflows =
      0;  // triangles with a coefficient or value beyond its register

  std::vector<std::uint32_t> colors() const;
};

ModelFrame run_model(const FrameSetup& frame, const Geometry& geometry,
                     Evaluation evaluation = best_evaluation());

}  // namespace phongpipe
