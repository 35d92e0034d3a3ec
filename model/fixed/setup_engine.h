// setup_engine: the coefficients T_i of every series of a triangle, each rounded once.
#pragma once

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

// Coefficients about the centre of pixel (x, y). Fraction bits: diffuse and gate
// diffuse_fraction_bits below one output LSB, specular specular_fraction_bits below one ROM
// address, cue_factor kCueFraction; these get kSetupExtraBits more with Anchor::span. Depth has
// kDepthFraction. The level (ambient and the rounding half) is folded into the T0 of diffuse.
// Rounding: to nearest. Overflow of 63 bits is reported.
struct TriangleSetup {
  int x = 0, y = 0;  // the expansion point's pixel
  std::uint32_t triangle = 0;
  std::uint32_t pass = 0;
  const MaterialSetup* material = nullptr;
  SeriesPlan plan;  // series that were set up; others are 0, the diffuse T0 the level
  std::array<FixedQuadratic, 3> diffuse;
  FixedQuadratic specular;
  FixedQuadratic gate;
  FixedLinear depth, cue_factor;
  bool overflow = false;
  // Of exact_path: the final colour of each pixel in the diffuse format, see exact_path.h.
  std::vector<std::array<std::int64_t, 3>> exact_values;
};

// The vertices of a triangle under the light of a pass, from the centre of pixel (x, y).
TriangleInput<double> triangle_input(const FrameSetup& frame, const ScreenTriangle& triangle,
                                     std::uint32_t pass, int x, int y);

class SetupEngine {
 public:
  explicit SetupEngine(const FrameSetup& frame);

  // (x, y): the pixel to expand about. It should be covered and near the centroid, so that its
  // normal lies between those of the corners. `longest_row` in pixels.
  //
  // Series that provably change no pixel are left out of the plan: a highlight whose words are all
  // 0, and light on a triangle that faces away from it. If all normals are equal, a series is only
  // its T0.
  //
  // With `fits`, these are the fits of the series, in place of the policy's.
  TriangleSetup set_up(std::uint32_t triangle, std::uint32_t pass, int x, int y, int longest_row,
                       const CertifiedFits* fits = nullptr) const;

  // The linear series of a triangle whose pixels exact_path shades in the first pass; no light.
  TriangleSetup set_up_exact(std::uint32_t triangle, std::uint32_t pass, int x, int y) const;

  // The unrounded coefficients of the material's whole plan, to split errors into their causes.
  TriangleCoefficients<double> coefficients(std::uint32_t triangle, std::uint32_t pass, int x,
                                            int y) const;

 private:
  // Without coefficients.
  TriangleSetup begin(std::uint32_t triangle, std::uint32_t pass, int x, int y) const;
  // What the frame's memo has of a triangle, or `otherwise` if it has no place for it.
  GeometryMemo::Triangle& known(std::uint32_t triangle, std::uint32_t pass,
                                GeometryMemo::Triangle& otherwise) const;
  // The material's plan, with constant series if all normals are equal.
  SeriesPlan simplified_plan(const MaterialSetup& material,
                             const TriangleInput<double>& vertices) const;
  // Removes series that provably change no pixel.
  void leave_out(SeriesPlan& plan, const MaterialSetup& material,
                 const TriangleInput<double>& vertices, const SeriesRange<double>& light,
                 const SeriesRange<double>& highlight, int longest_row) const;

  const FrameSetup* frame_;
};

}  // namespace phongpipe
