// exact_path: shades a triangle pixel by pixel under all lights at once, where no quadratic is good
// enough. Its pixels go through pixel_datapath as spans of one pixel, whose diffuse register holds
// the final colour; so the datapath is the same, and RTL takes these pixels, too.
//
// Values: the vectors of the triangle are stepped along each row and normalised at each pixel, in
// double precision (see exact_reflection.h). The colour, with ambient light and depth cue, is
// clamped to full scale and rounded to the diffuse register with the half that rounds to 8 bits.
// Error: least_certified_error_lsb(). A pixel is refused where rounding could cost more than
// kExactPathNoise: where an interpolated vector nearly vanishes, or a lit pixel with a highlight is
// on the terminator, or a pixel is on the edge of a spotlight's cone, to some 1e-12.
#pragma once

#include <vector>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"
#include "model/shading/exact_reflection.h"

namespace phongpipe {

// What the unit is told of a material: one entry a light.
std::vector<ExactLight<double>> exact_lights(const FrameSetup& frame, const Material& material);

struct ExactPixels {
  std::vector<std::array<std::int64_t, 3>> values;  // diffuse registers, row by row
  std::uint32_t refused = 0;                        // pixels of no proved error
};

// `rows`: of the triangle, see cover().
ExactPixels shade_exactly(const FrameSetup& frame, const ScreenTriangle& triangle,
                          const std::vector<RowSpan>& rows);

// What rounding may do to the share of a pixel's own colour under depth cueing: distances cancel
// out.
double cue_share_noise(const Scene& scene, const ScreenTriangle& triangle);

// The same pixels as rows of their own.
std::vector<RowSpan> one_pixel_rows(const std::vector<RowSpan>& rows);

}  // namespace phongpipe
