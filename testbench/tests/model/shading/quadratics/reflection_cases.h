// Random triangles under any light of the scene format, and what the exact reference makes of them.
#pragma once

#include "model/shading/phong.h"
#include "model/shading/quadratics/reflection_series.h"
#include "testbench/tests/model/shading/quadratics/random_cases.h"

namespace phongpipe {

// A triangle of unit size, its light and its eye as a scene has them. Attenuation is relative to
// the largest at a corner.
struct ReflectionCase {
  Scene scene;
  Light light;
  double power;
  Corners<double> normal, eye, to_light;  // of true length

  Vec at(const Corners<double>& q, double u, double v) const {
    return q[0] * (1 - u - v) + q[1] * u + q[2] * v;
  }
  Illumination illumination(double u, double v) const {
    return illuminate(scene, light, at(eye, u, v).normalized(), at(to_light, u, v));
  }
  double attenuation(double u, double v) const { return illumination(u, v).color[0]; }
  // A N·L
  double diffuse(double u, double v) const {
    const Illumination i = illumination(u, v);
    return i.color[0] * at(normal, u, v).normalized().dot(i.light);
  }
  // N·H or R·V
  double cosine(double u, double v) const {
    const Illumination i = illumination(u, v);
    const Vec n = at(normal, u, v).normalized();
    const double s = n.dot(i.highlight);
    return scene.shading.highlight == Highlight::halfway
               ? s
               : 2 * n.dot(i.light) * s - i.light.dot(i.highlight);
  }
  double reference() const {
    return std::max({attenuation(0, 0), attenuation(1, 0), attenuation(0, 1)});
  }

  ReflectionForm form(SeriesFit fit) const {
    ReflectionForm form;
    form.fit = fit;
    form.point_light = light.type != LightType::directional;
    form.local_viewer = scene.shading.viewer == Viewer::local;
    form.highlight = scene.shading.highlight;
    form.attenuated = form.point_light;
    form.spot_factor = light.type == LightType::spot;
    return form;
  }
  ReflectionTerms<double> terms() const {
    ReflectionTerms<double> terms;
    terms.to_light = to_light[0].normalized();
    terms.eye = eye[0].normalized();
    terms.halfway = (terms.to_light + terms.eye).normalized();
    for (std::size_t i = 0; i < 3; ++i) terms.attenuation[i] = light.attenuation[i] * reference();
    terms.spot_axis = -light.direction;
    terms.spot_exponent = light.spot_exponent;
    terms.fold = 1 / power;
    terms.sharpness = power - 1;
    return terms;
  }
  CosineSeries<double> series(const ReflectionForm& form) const {
    return reflection_series(form, unit_triangle<double>(), normal, eye, to_light, terms());
  }
};

inline double intensity(double x) {
  return 255 * std::min(1.0, std::max(0.0, x));
}

// Largest errors in LSB, full scale being N·L = 1 and s^n = 1 under the reference's light.
inline Reflected<double> largest_errors(const ReflectionCase& c, const CosineSeries<double>& q,
                                        int steps = 24) {
  Reflected<double> largest;
  const double reference = c.reference();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
      const double x = u - 1.0 / 3, y = v - 1.0 / 3;
      const double a = c.attenuation(u, v) / reference;
      const auto raised = [&c](double s) { return std::pow(std::max(0.0, s), c.power); };
      const double light = intensity(q.light(x, y)) - intensity(c.diffuse(u, v) / reference);
      const double highlight =
          intensity(raised(q.highlight(x, y))) - intensity(a * raised(c.cosine(u, v)));
      largest.light = std::max(largest.light, std::fabs(light));
      largest.highlight = std::max(largest.highlight, std::fabs(highlight));
    }
  }
  return largest;
}

class ReflectionCases : public RandomCases {
 public:
  using RandomCases::RandomCases;

  // Light and eye at `distance` from the centre of a triangle of side 1, a highlight about it. A
  // spot points at the triangle, its axis up to `distance` / 4 beside it.
  ReflectionCase reflection(LightType type, Viewer viewer, Highlight highlight, double turn,
                            double distance, double power, double spot_exponent = 0) {
    ReflectionCase c;
    c.scene.shading.viewer = viewer;
    c.scene.shading.highlight = highlight;
    c.power = power;
    c.light.type = type;
    c.light.attenuation = {0.2, 0.1 / distance, 0.7 / (distance * distance)};
    c.light.spot_exponent = spot_exponent;
    c.normal = normals(turn);
    const Vec axis = (c.normal[0] + c.normal[1] + c.normal[2]).normalized();
    const Vec side = axis.cross(unit()).normalized(), up = axis.cross(side);
    const double inclination = uniform(0, 45 * kDegrees), around = uniform(0, 6.28);
    const Vec tilt = std::cos(around) * side + std::sin(around) * up;
    const double r = std::sqrt(1.0 / 3), start = uniform(0, 6.28);
    const Vec middle = normal_inside(c.normal);
    const Vec to_light = std::cos(inclination) * axis + std::sin(inclination) * tilt;
    const Vec to_eye = 2 * middle.dot(to_light) * middle - to_light;
    c.light.direction = -(to_light + uniform(0, 0.25) * tilt).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = start + 120 * kDegrees * static_cast<double>(i);
      const Vec corner = r * (std::cos(angle) * side + std::sin(angle) * up);
      c.to_light[i] = distance * to_light;
      if (type != LightType::directional) c.to_light[i] -= corner;
      c.eye[i] = distance * to_eye;
      if (viewer == Viewer::local) c.eye[i] -= corner;
    }
    return c;
  }

 private:
  Vec normal_inside(const Corners<double>& n) {
    double u = uniform(0, 1), v = uniform(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return (n[0] * (1 - u - v) + n[1] * u + n[2] * v).normalized();
  }
};

}  // namespace phongpipe
