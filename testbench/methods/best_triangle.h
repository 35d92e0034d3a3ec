// One triangle shaded by the best quadratics: what better setup engines could still gain.
#pragma once

#include <vector>

#include "model/fixed/span.h"
#include "model/scene/geometry.h"
#include "model/shading/phong.h"
#include "model/shading/taylor.h"

namespace phongpipe {

class BestTriangle {
 public:
  // `rows`: the pixels that count, not empty. Scene, material and triangle must outlive it.
  BestTriangle(const Scene& scene, const Material& material, const ScreenTriangle& triangle,
               const std::vector<RowSpan>& rows);

  // As PhongTriangle::shade().
  void shade(int x, int y, int length, Color* colors) const;

 private:
  // The series of one light.
  struct Series {
    Quadratic<double> light, highlight;  // about the middle of pixel (origin_x_, origin_y_)
  };

  Illumination illuminate_at(std::size_t light, double x, double y) const;

  const Scene& scene_;
  const Material& material_;
  int origin_x_, origin_y_;
  Linear<Vec3> eye_;
  std::vector<Linear<Vec3>> to_light_;
  std::vector<Series> series_;
};

}  // namespace phongpipe
