#include "model/scene/clip.h"

#include <algorithm>

namespace phongpipe {
namespace {

// The near plane comes first: the others mean anything only where w > 0.
constexpr int kPlanes = 5;

// Positive inside; linear in the homogeneous coordinates.
double distance(const ClipVertex& v, const ViewVolume& volume, int plane) {
  switch (plane) {
    case 0:
      return v.depth - volume.near;
    case 1:
      return v.x + volume.margin * v.w;
    case 2:
      return (volume.width + volume.margin) * v.w - v.x;
    case 3:
      return v.y + volume.margin * v.w;
    default:
      return (volume.height + volume.margin) * v.w - v.y;
  }
}

ClipVertex interpolate(const ClipVertex& a, const ClipVertex& b, double t) {
  const auto mix = [t](const auto& from, const auto& to) { return from + (to - from) * t; };
  ClipVertex result;
  result.x = mix(a.x, b.x);
  result.y = mix(a.y, b.y);
  result.w = mix(a.w, b.w);
  result.depth = mix(a.depth, b.depth);
  result.position = mix(a.position, b.position);
  result.normal = mix(a.normal, b.normal);
  return result;
}

}  // namespace

bool wholly_outside(const ClipTriangle& triangle, const ViewVolume& volume) {
  for (int plane = 0; plane < kPlanes; ++plane) {
    if (std::all_of(triangle.begin(), triangle.end(),
                    [&](const ClipVertex& v) { return distance(v, volume, plane) < 0; })) {
      return true;
    }
  }
  return false;
}

bool wholly_inside(const ClipTriangle& triangle, const ViewVolume& volume) {
  return std::all_of(triangle.begin(), triangle.end(), [&](const ClipVertex& v) {
    for (int plane = 0; plane < kPlanes; ++plane) {
      if (distance(v, volume, plane) < 0) {
        return false;
      }
    }
    return true;
  });
}

std::vector<ClipVertex> clip(const ClipTriangle& triangle, const ViewVolume& volume) {
  std::vector<ClipVertex> polygon(triangle.begin(), triangle.end());
  for (int plane = 0; plane < kPlanes && !polygon.empty(); ++plane) {
    std::vector<ClipVertex> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const ClipVertex& from = polygon[i];
      const ClipVertex& to = polygon[(i + 1) % polygon.size()];
      const double from_distance = distance(from, volume, plane);
      const double to_distance = distance(to, volume, plane);
      if (from_distance >= 0) {
        kept.push_back(from);
      }
      if ((from_distance >= 0) != (to_distance >= 0)) {
        // Always from the inner vertex outwards, so that both neighbours round alike.
        kept.push_back(from_distance >= 0
                           ? interpolate(from, to, from_distance / (from_distance - to_distance))
                           : interpolate(to, from, to_distance / (to_distance - from_distance)));
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

}  // namespace phongpipe
