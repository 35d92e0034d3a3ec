// Certified errors: for every triangle the cheapest shading whose error is proved to be at most the
// setup engine's max_error, at every pixel and for all lights together.
//
// Of a light's diffuse term, in LSB:     255 kd (κ |f'''| + noise) + rounding of its series
// Of its highlight of exponent n, where the power's base is off by δ = κ |f'''| + noise + rounding:
//   at most n s^(n−1) δ of its full size, s being the largest base on the triangle; and never more
//   than the highlight is there, s^n; and the table's error. Where the gate may open or close on
//   the wrong side of the terminator it is the highlight itself.
// Of each light, ½ LSB where its sum is rounded to 8 bits. Saturation only lessens errors.
// κ |f'''| bounds the error of a Taylor series or of interpolation at six points, see
// derivative_bounds.h; the other fits have no bound that is less than that of six points, and cost
// more. noise is that of double precision, see coefficient_noise() in certificate.cpp; rounding
// that of rounding_bound.h.
//
// Triangles that no quadratic serves are split, where the pieces cost less than shading them pixel
// by pixel, else they take exact_path.
#pragma once

#include <optional>

#include "model/fixed/frame_setup.h"
#include "model/fixed/setup_engine.h"
#include "model/fixed/shading_path.h"

namespace phongpipe {

// Of a triangle by quadratics: the fits that suffice, or six points for all if none do.
struct QuadraticError {
  double error_lsb = 0;   // of all lights
  double series_lsb = 0;  // of it, by the series: each split leaves an eighth
};

class Certifier {
 public:
  // `frame`: a frame that certifies.
  explicit Certifier(const FrameSetup& frame) : frame_(frame) {}

  // `rows`: the triangle's, not empty. Appends a choice for each light to `fits`, if not null.
  QuadraticError bound(const ScreenTriangle& triangle, const std::vector<RowSpan>& rows,
                       std::vector<CertifiedFits>* fits) const;

  // Whether splitting the triangle costs less than shading it pixel by pixel. `levels`: that may
  // follow.
  bool wants_split(const ScreenTriangle& triangle, int levels) const;

 private:
  const FrameSetup& frame_;
};

// How a triangle that was set up is shaded.
ShadingPath path_of(const FrameSetup& frame, const TriangleSetup& setup);
// Adds its pixels to the ledger.
void count_pixels(const FrameSetup& frame, const TriangleSetup& setup, std::uint64_t pixels,
                  Ledger& ledger);

// The largest error that is proved for the frame's pixels; none if nothing is certified.
std::optional<double> certified_error(const FrameSetup& frame);

// The choices for all triangles of the frame.
Certificates certify(const FrameSetup& frame);

}  // namespace phongpipe
