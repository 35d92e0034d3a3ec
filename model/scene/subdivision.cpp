#include "model/scene/subdivision.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace phongpipe {
namespace {

constexpr double kPi = 3.14159265358979323846;

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The largest angle between what `vector_at` says of two corners.
template <typename VectorAt>
double turn(const ScreenTriangle& triangle, const VectorAt& vector_at) {
  const auto& [a, b, c] = triangle.vertices;
  const Vec3 u = vector_at(a), v = vector_at(b), w = vector_at(c);
  return std::max({angle(u, v), angle(v, w), angle(w, u)});
}

// How far from its middle a power falls below an LSB.
double reach_of_power(double exponent) {
  constexpr double kLsb = 1.0 / 255;
  return std::acos(std::pow(kLsb, 1 / exponent));
}

// By how much normals turn from the middle of a highlight to where it falls below an LSB. R turns
// twice as fast as N.
double radius_of_highlight(const Scene& scene, const Material& material) {
  const double radius = reach_of_power(material.shininess);
  return scene.shading.highlight == Highlight::reflection ? radius / 2 : radius;
}

ScreenVertex middle(const ScreenVertex& a, const ScreenVertex& b) {
  ScreenVertex result;
  result.x = (a.x + b.x) / 2;  // even, as long as there are levels left
  result.y = (a.y + b.y) / 2;
  result.z = (a.z + b.z) / 2;
  result.normal = (a.normal + b.normal) / 2;
  result.eye = (a.eye + b.eye) / 2;
  result.position = (a.position + b.position) / 2;
  return result;
}

Vec3 halfway(const Light& light, const ScreenVertex& v) {
  return v.eye.normalized() + light_vector(light, v).normalized();
}

// How close a normal of a corner or of the middle of an edge comes to the middle of a highlight.
double nearest_highlight(const Light& light, const ScreenTriangle& triangle) {
  const auto& [a, b, c] = triangle.vertices;
  double nearest = kPi;
  for (const ScreenVertex& v : {a, b, c, middle(a, b), middle(b, c), middle(c, a)}) {
    nearest = std::min(nearest, angle(v.normal, halfway(light, v)));
  }
  return nearest;
}

class SharpTurns {
 public:
  SharpTurns(const Scene& scene, const Geometry& geometry, int largest_turn_degrees)
      : scene_(scene), largest_turn_(largest_turn_degrees * kPi / 180) {
    for (const Material& material : geometry.materials) {
      highlight_radius_.push_back(is_shiny(material) ? radius_of_highlight(scene, material)
                                                     : 2 * kPi);
    }
    for (const Light& light : scene.lights) light_limit_.push_back(limit_of(light));
  }

  bool on(const ScreenTriangle& triangle) const {
    const double turned = turn(triangle, [](const ScreenVertex& v) { return v.normal; });
    if (turned > largest_turn_) return true;
    const double radius = highlight_radius_[triangle.material];
    const bool local = scene_.shading.viewer == Viewer::local;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const Light& light = scene_.lights[i];
      const bool near = light.type != LightType::directional;
      if (near && turn(triangle, [&](const ScreenVertex& v) { return light_vector(light, v); }) >
                      light_limit_[i]) {
        return true;
      }
      double bent = turned;
      if (near || local) {
        bent += turn(triangle, [&](const ScreenVertex& v) { return halfway(light, v); });
      }
      // No point of a triangle is farther from its corners and middles than a share of its sides.
      const double between = bent / std::sqrt(12.0);
      if (bent > radius && nearest_highlight(light, triangle) < radius + between) return true;
    }
    return false;
  }

 private:
  // Light of a lamp close by bends by its own turning, and by that of the normals; within a cone it
  // fades with a power.
  double limit_of(const Light& light) const {
    if (light.type == LightType::directional) return kPi;
    constexpr double kShareOfReach = 1.0 / 3;
    const double cone =
        has_spot_factor(light) ? kShareOfReach * reach_of_power(light.spot_exponent) : kPi;
    return std::min(largest_turn_ / 2, cone);
  }

  const Scene& scene_;
  double largest_turn_;
  std::vector<double> highlight_radius_;  // by material
  std::vector<double> light_limit_;       // by light
};

void append(const ScreenTriangle& triangle, int levels, const WantsSplit& wants,
            std::vector<ScreenTriangle>& pieces) {
  if (levels == 0 || !wants(triangle, levels)) {
    pieces.push_back(triangle);
    return;
  }
  const auto& [a, b, c] = triangle.vertices;
  const ScreenVertex ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  for (const auto& corners : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
    append({corners, triangle.material, true}, levels - 1, wants, pieces);
  }
}

}  // namespace

Subdivision subdivide(const Geometry& geometry, const WantsSplit& wants) {
  Subdivision result;
  result.geometry = geometry;
  std::vector<ScreenTriangle>& pieces = result.geometry.triangles;
  pieces.clear();
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    append(geometry.triangles[i], kSubdivisionLevels, wants, pieces);
    const std::size_t made = pieces.size() - result.whole.size();
    if (made > 1) {
      ++result.split;
      result.pieces += made;
    }
    result.whole.resize(pieces.size(), i);
  }
  return result;
}

Subdivision subdivide(const Scene& scene, const Geometry& geometry, int largest_turn_degrees) {
  if (largest_turn_degrees == 0) {
    return subdivide(geometry, [](const ScreenTriangle&, int) { return false; });
  }
  const SharpTurns sharp_turns(scene, geometry, largest_turn_degrees);
  return subdivide(geometry,
                   [&](const ScreenTriangle& triangle, int) { return sharp_turns.on(triangle); });
}

}  // namespace phongpipe
