// Certified errors: for every triangle the cheapest shading whose error is proved to be at most the
// setup engine's max_error, at every pixel and for all lights together.
//
// A series that stands for f errs by at most κ |f'''|: of a Taylor series or of interpolation at
// six points, see derivative_bounds.h. With noise, that of double precision (see
// coefficient_noise() in certificate.cpp), and rounding, that of rounding_bound.h, the errors are
//
// of a light's diffuse term, in LSB:     255 kd (κ |f'''| + noise) + rounding
// of its highlight, in full highlights:  n s^(n−1) δ, the base of the power being off by δ =
//                                        κ |f'''| + noise + rounding and at most s; but never more
//                                        than the highlight is there, s^n
//
// and, of a highlight, the table's error. Where the gate may open or close on the wrong side of the
// terminator, the error is the highlight itself. Each light's sum is rounded to 8 bits by ½ LSB;
// saturation only lessens errors. Of the other fits nothing better is known than the bound of six
// points plus their difference from it, so that they are not chosen.
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
  double series_lsb = 0;  // the part of it that splitting reduces, to an eighth each time
};

class Certifier {
 public:
  // `frame`: a frame that certifies.
  explicit Certifier(const FrameSetup& frame);

  // `rows`: the triangle's, not empty. Appends a choice for each light to `fits`, if not null.
  QuadraticError bound(const ScreenTriangle& triangle, const std::vector<RowSpan>& rows,
                       std::vector<CertifiedFits>* fits) const;

  // Whether splitting the triangle costs less than shading it pixel by pixel. `levels`: that may
  // follow.
  bool wants_split(const ScreenTriangle& triangle, int levels) const;

 private:
  const FrameSetup& frame_;
  std::vector<double> table_errors_;  // of each table of the frame, in LSB
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
