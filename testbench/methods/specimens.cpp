#include "testbench/methods/specimens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/fixed/coverage.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

constexpr double kPi = 3.14159265358979323846, kDegree = kPi / 180;
constexpr double kSide = 40;  // of a triangle, in pixels
constexpr int kImageSize = 64;

// The unit vector `tilt` from a unit axis.
Vec3 tilted(const Vec3& axis, double tilt, double around) {
  const Vec3 side = axis.unitOrthogonal(), other = axis.cross(side);
  return std::cos(tilt) * axis +
         std::sin(tilt) * (std::cos(around) * side + std::sin(around) * other);
}

double arc(double a, double b) {
  return std::fabs(std::remainder(a - b, 2 * kPi));
}

// Corners and normals lie around a circle and a cone.
ScreenTriangle random_triangle(double spread, Random& random) {
  const double start = random.uniform(0, 2 * kPi);
  std::array<double, 3> around;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr double kJitter = 30 * kDegree;
    around[i] = start + 120 * kDegree * static_cast<double>(i) + random.uniform(-kJitter, kJitter);
  }
  const double widest =
      std::max({arc(around[0], around[1]), arc(around[1], around[2]), arc(around[2], around[0])});
  const double tilt = std::asin(std::sin(spread / 2) / std::sin(widest / 2));
  const double radius = kSide / std::sqrt(3.0);
  ScreenTriangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    ScreenVertex& v = triangle.vertices[i];
    v.x = snap(kImageSize / 2.0 + radius * std::cos(around[i]));
    v.y = snap(kImageSize / 2.0 + radius * std::sin(around[i]));
    v.normal = tilted(Vec3(0, 0, -1), tilt, around[i]);
    // Positions stay 0: the polygon's own normal is then the mean of its corners'.
  }
  return triangle;
}

// A normal inside the triangle, away from its edges.
Vec3 random_peak(const ScreenTriangle& triangle, Random& random) {
  constexpr double kLeast = 0.1;
  double u = random.uniform(0, 1), v = random.uniform(0, 1);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const double range = 1 - 3 * kLeast;
  const double w0 = kLeast + range * u, w1 = kLeast + range * v;
  const auto& corner = triangle.vertices;
  const Vec3 normal =
      w0 * corner[0].normal + w1 * corner[1].normal + (1 - w0 - w1) * corner[2].normal;
  return normal.normalized();
}

Specimen random_specimen(const SpecimenKind& kind, Random& random) {
  Specimen specimen;
  specimen.triangle = random_triangle(kind.spread_degrees * kDegree, random);
  const Vec3 peak = random_peak(specimen.triangle, random);
  // Evenly over the cap of directions.
  const double cosine = random.uniform(std::cos(kind.eye_from_peak_degrees * kDegree), 1);
  const Vec3 eye = tilted(peak, std::acos(cosine), random.uniform(0, 2 * kPi));
  for (ScreenVertex& vertex : specimen.triangle.vertices) vertex.eye = eye;
  Scene& scene = specimen.scene;
  scene.shading.ambient_light = Color::Zero();
  scene.shading.highlight = kind.highlight;
  scene.lights.resize(1);
  scene.lights[0].direction = (eye - 2 * eye.dot(peak) * peak).normalized();
  cover(specimen.triangle, kImageSize, kImageSize, specimen.rows);
  for (const RowSpan& row : specimen.rows) specimen.pixels += static_cast<std::size_t>(row.length);
  return specimen;
}

}  // namespace

std::unique_ptr<TriangleShader> Specimen::shader(const ShadingMethod& method) const {
  const OriginPixel origin = centroid_pixel(triangle);
  const Power power(PowerKind::exact, material.shininess);
  return method.create({scene, material, triangle, power, origin.x, origin.y});
}

std::vector<double> Specimen::shade(const ShadingMethod& method) const {
  const std::unique_ptr<TriangleShader> shading = shader(method);
  std::vector<double> levels;
  levels.reserve(pixels);
  std::array<Color, kImageSize> colors;
  for (const RowSpan& row : rows) {
    shading->shade(row.x, row.y, row.length, colors.data());
    for (int i = 0; i < row.length; ++i) levels.push_back(colors[static_cast<std::size_t>(i)][0]);
  }
  return levels;
}

std::vector<Reflection<double>> Specimen::reflect(const ShadingMethod& method) const {
  const std::unique_ptr<TriangleShader> shading = shader(method);
  std::vector<Reflection<double>> reflections(pixels);
  Reflection<double>* next = reflections.data();
  for (const RowSpan& row : rows) {
    shading->reflect(row.x, row.y, row.length, next);
    next += row.length;
  }
  return reflections;
}

std::vector<Specimen> random_specimens(const SpecimenKind& kind, int count, std::uint32_t seed) {
  Random random(seed);
  std::vector<Specimen> specimens;
  specimens.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) specimens.push_back(random_specimen(kind, random));
  return specimens;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::fabs(a[i] - b[i]);
    if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace phongpipe
