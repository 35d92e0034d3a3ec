#include "model/scene/subdivision.h"

#include <Eigen/Geometry>
#include <cmath>

namespace phongpipe {
namespace {

constexpr double kRadiansPerDegree = 0.017453292519943295;

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool turns_by_more(const ScreenTriangle& triangle, double radians) {
  const auto& [a, b, c] = triangle.vertices;
  return angle(a.normal, b.normal) > radians || angle(b.normal, c.normal) > radians ||
         angle(c.normal, a.normal) > radians;
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

void append(const ScreenTriangle& triangle, double radians, int levels,
            std::vector<ScreenTriangle>& pieces) {
  if (levels == 0 || !turns_by_more(triangle, radians)) {
    pieces.push_back(triangle);
    return;
  }
  const auto& [a, b, c] = triangle.vertices;
  const ScreenVertex ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
  for (const auto& corners : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
    append({corners, triangle.material}, radians, levels - 1, pieces);
  }
}

}  // namespace

Subdivision subdivide(const Geometry& geometry, int largest_turn_degrees) {
  Subdivision result;
  result.geometry = geometry;
  std::vector<ScreenTriangle>& pieces = result.geometry.triangles;
  pieces.clear();
  const int levels = largest_turn_degrees > 0 ? kSubdivisionLevels : 0;
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    append(geometry.triangles[i], largest_turn_degrees * kRadiansPerDegree, levels, pieces);
    const std::size_t made = pieces.size() - result.whole.size();
    if (made > 1) {
      ++result.split;
      result.pieces += made;
    }
    result.whole.resize(pieces.size(), i);
  }
  return result;
}

}  // namespace phongpipe
