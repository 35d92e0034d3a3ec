// setup_engine: the coefficients T_i of every series of a triangle, each rounded once.
#pragma once

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

// Coefficients about the centre of pixel (x, y). Q-formats: diffuse and gate have
// diffuse_fraction_bits below one output LSB, specular specular_fraction_bits below one ROM
// address, each kSetupExtraBits more with Anchor::span; depth kDepthFraction, cue_factor
// kCueFraction and as many extra bits. The level (ambient and the rounding half) is folded into the
// T0 of diffuse. Rounding: to nearest. Overflow of 63 bits is reported.
struct TriangleSetup {
  int x = 0, y = 0;  // the expansion point's pixel
  std::uint32_t triangle = 0;
  std::uint32_t pass = 0;
  const MaterialSetup* material = nullptr;
  SeriesPlan plan;  // what was set up; what was not is 0, the diffuse T0 the level
  std::array<FixedQuadratic, 3> diffuse;
  FixedQuadratic specular;
  FixedQuadratic gate;
  FixedLinear depth, cue_factor;
  bool overflow = false;
};

class SetupEngine {
 public:
  explicit SetupEngine(const FrameSetup& frame);

  // (x, y): the pixel to expand about; it should be a covered one near the centroid, so that the
  // series is never evaluated outside the triangle's own normals. `longest_row` in pixels.
  //
  // What provably changes no pixel is left out of the plan: a highlight whose words are all 0,
  // light on triangles that face away from it. Over equal normals a series is its T0.
  TriangleSetup set_up(std::uint32_t triangle, std::uint32_t pass, int x, int y,
                       int longest_row) const;

  // The same before rounding, for the split of errors.
  TriangleCoefficients<double> coefficients(std::uint32_t triangle, std::uint32_t pass, int x,
                                            int y) const;

 private:
  TriangleInput<double> input(std::uint32_t triangle, std::uint32_t pass, int x, int y) const;
  // The material's plan, but that series over equal normals are constant.
  SeriesPlan simplified_plan(const MaterialSetup& material,
                             const TriangleInput<double>& vertices) const;
  // Takes out of the plan what provably changes no pixel.
  void leave_out(SeriesPlan& plan, const MaterialSetup& material,
                 const TriangleInput<double>& vertices, const TriangleBounds<double>& bounds,
                 int longest_row) const;

  const FrameSetup* frame_;
};

// Fraction bits the T_i are held with, for a series of `fraction_bits` in the datapath.
inline int setup_fraction_bits(const FixedPointFormats& formats, int fraction_bits) {
  return fraction_bits + (formats.anchor == Anchor::span ? kSetupExtraBits : 0);
}

}  // namespace phongpipe
