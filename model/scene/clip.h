// Clipping in homogeneous coordinates, before the division by w.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

// A vertex in homogeneous pixel coordinates: its pixel is (x/w, y/w). An orthographic camera has
// w = 1 everywhere.
struct ClipVertex {
  double x = 0;
  double y = 0;
  double w = 1;
  double depth = 0;  // distance from the eye along the view
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
};

using ClipTriangle = std::array<ClipVertex, 3>;

// The visible region: depth ≥ near, and pixels from the top left corner to (width, height), widened
// by `margin` pixels on all sides.
struct ViewVolume {
  double near = 0;
  double width = 0;
  double height = 0;
  double margin = 0;
};

// Whether all three vertices are outside the same plane; no part of the triangle is inside then.
bool wholly_outside(const ClipTriangle& triangle, const ViewVolume& volume);
bool wholly_inside(const ClipTriangle& triangle, const ViewVolume& volume);

// The part of the triangle inside the volume: a convex polygon in the triangle's vertex order, or
// fewer than 3 vertices if nothing is inside. Positions and normals are interpolated linearly, so
// normals of new vertices are not unit. An edge shared by two triangles is cut at the same point in
// both.
std::vector<ClipVertex> clip(const ClipTriangle& triangle, const ViewVolume& volume);

}  // namespace phongpipe
