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
  std::vector<ShadedPixel> stream;   // every shaded pixel, in order, before the depth test
  std::vector<TracedSpan> spans;     // where they come from
  Framebuffer framebuffer;           // values are places in the stream
  std::size_t triangles_set_up = 0;  // those that cover a pixel
  std::size_t coefficient_overflows =
      0;  // triangles with a coefficient or value beyond its register

  // Of a pixel of the image, channel 0 in the low byte.
  std::uint32_t color(std::size_t index) const {
    return framebuffer.covered(index) ? stream[framebuffer.value(index)].color
                                      : framebuffer.background();
  }
  std::vector<std::uint32_t> colors() const;
};

ModelFrame run_model(const FrameSetup& frame, const Geometry& geometry,
                     Evaluation evaluation = best_evaluation());

}  // namespace phongpipe
