// Random triangles of about 40 pixels, each with a light and an eye of its own at infinity, on
// which shading methods are compared.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/fixed/span.h"
#include "model/shading/methods/shading_method.h"

namespace phongpipe {

struct SpecimenKind {
  double spread_degrees = 20;         // the largest angle between two normals of a triangle
  double eye_from_peak_degrees = 30;  // the eye is at most so far from the highlight's peak, which
                                      // is inside the triangle; the light is opposite
  Highlight highlight = Highlight::halfway;
};

// Light and eye need not be where the screen would have them: shading depends only on the angles
// between them and the normals. No ambient light.
struct Specimen {
  Scene scene;
  Material material;
  ScreenTriangle triangle;
  std::vector<RowSpan> rows;  // the pixels covered
  std::size_t pixels = 0;

  // Of the covered pixels, row by row; power exact. Levels in LSB of the first channel.
  std::vector<double> shade(const ShadingMethod& method) const;
  std::vector<Reflection<double>> reflect(const ShadingMethod& method) const;

 private:
  std::unique_ptr<TriangleShader> shader(const ShadingMethod& method) const;
};

// The same triangles and angles around for each kind, only tilted more or less.
std::vector<Specimen> random_specimens(const SpecimenKind& kind, int count, std::uint32_t seed);

// Infinite where a level is not a number.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace phongpipe
