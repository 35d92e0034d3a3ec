// Clipping in homogeneous coordinates, before the division by w.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

// A vertex between the camera and the screen: its pixel is (x/w, y/w). An orthographic camera has
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

// What may be seen: depth ≥ near, and pixels from the left top corner to (width, height), widened
// by `margin` pixels on all sides.
struct ViewVolume {
  double near = 0;
  double width = 0;
  double height = 0;
  double margin = 0;
};

// All three vertices are beyond the same plane, so that nothing of the triangle is inside.
bool wholly_outside(const ClipTriangle& triangle, const ViewVolume& volume);
bool wholly_inside(const ClipTriangle& triangle, const ViewVolume& volume);

// The convex polygon left of the triangle, in its order; fewer than 3 vertices where nothing is.
// Positions and normals are interpolated linearly, so normals there are not unit any more. An edge
// shared by two triangles is cut at the same point in both.
std::vector<ClipVertex> clip(const ClipTriangle& triangle, const ViewVolume& volume);

}  // namespace phongpipe
