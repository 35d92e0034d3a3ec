// The colour of each pixel at every link of the chain exact Phong → real polynomial → rounded
// coefficients → ROM → 8-bit output. All lights together.
#pragma once

#include <cstdint>
#include <functional>

#include "model/fixed/front_end.h"
#include "model/fixed/model_frame.h"

namespace phongpipe {

// The colours of one visible pixel along the chain, in LSB; the channels in use only.
struct ErrorChain {
  std::size_t index = 0;  // of the pixel in the image
  Color exact;            // Phong shading, normals normalised at the pixel
  Color polynomial;       // the series in real arithmetic, exact powers
  Color rounded;          // the datapath's series, exact powers
  Color table;            // the datapath's series and ROM words
  Color output;           // the datapath's output
};

// Calls `visit` for every visible pixel of the model's frame, triangle by triangle from `first` to
// before `end`.
void for_each_visible_pixel(const FrameSetup& frame, const ModelFrame& model, std::uint32_t first,
                            std::uint32_t end, const std::function<void(const ErrorChain&)>& visit);
// The same for all triangles.
void for_each_visible_pixel(const FrameSetup& frame, const ModelFrame& model,
                            const std::function<void(const ErrorChain&)>& visit);

}  // namespace phongpipe
