// Random triangles with sides of about 40 pixels, each with its own light and eye at infinity, for
// comparing shading methods.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/fixed/span.h"
#include "model/shading/methods/shading_method.h"

namespace phongpipe {

struct SpecimenKind {
  double spread_degrees = 20;  // the largest angle between two normals of a triangle
  // Largest angle between the eye and the normal at the highlight's peak. The peak is inside the
  // triangle; the light is opposite.
  double eye_from_peak_degrees = 30;
  Highlight highlight = Highlight::halfway;
};

// Light and eye may lie anywhere relative to the screen, because shading depends only on the angles
// between them and the normals. No ambient light.
struct Specimen {
  Scene scene;
  Material material;
  ScreenTriangle triangle;
  std::vector<RowSpan> rows;  // the pixels covered
  std::size_t pixels = 0;

  // Values of the covered pixels, row by row, with exact power. Levels in LSB of the first channel.
  std::vector<double> shade(const ShadingMethod& method) const;
  std::vector<Reflection<double>> reflect(const ShadingMethod& method) const;

 private:
  std::unique_ptr<TriangleShader> shader(const ShadingMethod& method) const;
};

// With one seed, all kinds have the same triangles and azimuths; only the tilts differ.
std::vector<Specimen> random_specimens(const SpecimenKind& kind, int count, std::uint32_t seed);

// Infinite if a level is NaN.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace phongpipe
