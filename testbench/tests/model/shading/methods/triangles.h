// Scenes of one triangle, for the tests of shading methods.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "model/shading/methods/shading_method.h"
#include "testbench/system/random.h"

namespace phongpipe {

inline std::ostream& operator<<(std::ostream& out, const OperationCounts& counts) {
  return out << counts.add << " add, " << counts.multiply << " mul, " << counts.rsqrt << " rsqrt, "
             << counts.divide << " div, " << counts.sqrt << " sqrt, " << counts.read << " read";
}

constexpr double kDegree = 3.14159265358979323846 / 180;

// One triangle in the plane z = 0 of a right-handed world seen from +z, in pixels.
struct OneTriangle {
  Scene scene;
  Material material;
  ScreenTriangle triangle;

  OneTriangle() {
    scene.shading.ambient_light = Color::Constant(0);
    scene.lights.resize(1);
    light_from(Vec3(0.3, 0.4, 1));
    material.diffuse = Color::Constant(0.6);
    material.specular = Color::Constant(0.4);
    corner(0, 100, 60, Vec3(0, 0, 1));
    corner(1, 60, 130, Vec3(0, 0, 1));
    corner(2, 140, 120, Vec3(0, 0, 1));
  }

  void light_from(const Vec3& to_light) { scene.lights[0].direction = -to_light.normalized(); }
  void corner(std::size_t i, double x, double y, const Vec3& normal) {
    ScreenVertex& v = triangle.vertices[i];
    v.x = snap(x);
    v.y = snap(y);
    v.position = Vec3(x - 100, 100 - y, 0);
    v.normal = normal.normalized();
    v.eye = Vec3(0, 0, 1);
  }
  void eye_at(const Vec3& eye) {
    scene.shading.viewer = Viewer::local;
    scene.camera.eye = eye;
    scene.camera.target = Vec3::Zero();
    for (ScreenVertex& v : triangle.vertices) v.eye = eye - v.position;
  }

  std::unique_ptr<TriangleShader> shader(std::string_view name,
                                         PowerKind power = PowerKind::exact) const {
    const OriginPixel origin = centroid_pixel(triangle);
    const Power of_material(power, material.shininess);
    return find_shading_method(name)->create(
        {scene, material, triangle, of_material, origin.x, origin.y});
  }

  // By rows through the inside of the triangle that OneTriangle() makes.
  template <typename Visit>
  static void for_each_span(Visit visit) {
    for (int y = 62; y < 124; ++y) {
      const int left = static_cast<int>(std::ceil(100 - 40 * (y + 0.5 - 60) / 70));
      const int right = static_cast<int>(std::floor(100 + 40 * (y + 0.5 - 60) / 60));
      if (right > left) visit(left, y, right - left);
    }
  }
};

// What a method makes of one pixel.
inline Reflection<double> at(const OneTriangle& t, std::string_view method, int x, int y) {
  Reflection<double> reflection;
  t.shader(method)->reflect(x, y, 1, &reflection);
  return reflection;
}

// What it is given; without a power.
inline ShadingInput<double> input(const OneTriangle& t) {
  const OriginPixel origin = centroid_pixel(t.triangle);
  const Power power(PowerKind::exact, 1);
  ShadingInput<double> in =
      shading_input({t.scene, t.material, t.triangle, power, origin.x, origin.y});
  in.power = nullptr;
  return in;
}

// Largest difference between two methods' colours, in LSB.
inline double largest_difference(const OneTriangle& scene, std::string_view method,
                                 std::string_view reference = "phong",
                                 PowerKind power = PowerKind::exact) {
  const auto a = scene.shader(method, power), b = scene.shader(reference);
  std::vector<Color> as(256), bs(256);
  double largest = 0;
  OneTriangle::for_each_span([&](int x, int y, int length) {
    a->shade(x, y, length, as.data());
    b->shade(x, y, length, bs.data());
    for (std::size_t i = 0; i < static_cast<std::size_t>(length); ++i) {
      const double difference = (as[i] - bs[i]).abs().maxCoeff();
      largest = std::isfinite(difference) ? std::max(largest, difference)
                                          : std::numeric_limits<double>::infinity();
    }
  });
  return largest;
}

// A direction at most `degrees` from +z.
inline Vec3 direction_within(double degrees, Random& random) {
  const double angle = random.uniform(0, degrees * kDegree);
  const double turn = random.uniform(0, 360 * kDegree);
  return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
}

// Random normals that spread at most `degrees` from one another.
inline OneTriangle random_triangle(double degrees, unsigned seed) {
  Random random(seed);
  OneTriangle result;
  for (ScreenVertex& v : result.triangle.vertices) v.normal = direction_within(degrees / 2, random);
  result.light_from(direction_within(70, random));
  return result;
}

}  // namespace phongpipe
