// Projection from world coordinates to homogeneous pixel coordinates.
#pragma once

#include "model/scene/clip.h"
#include "model/scene/geometry.h"
#include "model/scene/scene.h"

namespace phongpipe {

// The near plane lies at this fraction of the distance from eye to target.
constexpr double kNearFraction = 1.0 / 1024;

class ScreenProjection {
 public:
  explicit ScreenProjection(const Scene& scene);

  double near() const { return near_; }
  ClipVertex to_clip(const Vec3& position, const Vec3& normal) const;

  // Divides by w and snaps. z is linear in screen space: 1 - near/w in perspective (0 at the near
  // plane, 1 at infinity), else the distance from the eye along the view.
  ScreenVertex to_screen(const ClipVertex& vertex) const;

 private:
  Camera camera_;
  bool local_viewer_;
  Vec3 right_, down_, forward_;  // unit, the axes of the screen
  double near_;
  double pixels_per_unit_;  // at w = 1
  double center_x_, center_y_;
};

}  // namespace phongpipe
