#include "model/scene/projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace phongpipe {

ScreenProjection::ScreenProjection(const Scene& scene)
    : camera_(scene.camera),
      local_viewer_(scene.shading.viewer == Viewer::local),
      center_x_(scene.image.width / 2.0),
      center_y_(scene.image.height / 2.0) {
  constexpr double kRadiansPerDegree = 0.017453292519943295;
  const Vec3 view = camera_.target - camera_.eye;
  forward_ = view.normalized();
  right_ = forward_.cross(camera_.up.normalized()).normalized();
  down_ = forward_.cross(right_);
  near_ = kNearFraction * view.norm();
  const double visible_height =
      camera_.projection == Projection::perspective
          ? 2 * std::tan(camera_.vertical_fov_degrees / 2 * kRadiansPerDegree)
          : camera_.vertical_extent;
  pixels_per_unit_ = scene.image.height / visible_height;
}

ClipVertex ScreenProjection::to_clip(const Vec3& position, const Vec3& normal) const {
  const Vec3 from_eye = position - camera_.eye;
  ClipVertex vertex;
  vertex.depth = from_eye.dot(forward_);
  vertex.w = camera_.projection == Projection::perspective ? vertex.depth : 1;
  vertex.x = pixels_per_unit_ * from_eye.dot(right_) + center_x_ * vertex.w;
  vertex.y = pixels_per_unit_ * from_eye.dot(down_) + center_y_ * vertex.w;
  vertex.position = position;
  vertex.normal = normal;
  return vertex;
}

ScreenVertex ScreenProjection::to_screen(const ClipVertex& vertex) const {
  ScreenVertex result;
  // Clipping rounds, the more the farther out a vertex was: the guard band's border is kept here.
  const auto snap_inside = [&vertex](double position, double center) {
    return snap(std::clamp<double>(position / vertex.w, -kGuardBand, 2 * center + kGuardBand));
  };
  result.x = snap_inside(vertex.x, center_x_);
  result.y = snap_inside(vertex.y, center_y_);
  result.z = camera_.projection == Projection::perspective ? 1 - near_ / vertex.w : vertex.depth;
  result.normal = vertex.normal;
  result.position = vertex.position;
  result.eye = local_viewer_ ? Vec3(camera_.eye - vertex.position) : Vec3(-forward_);
  return result;
}

}  // namespace phongpipe
