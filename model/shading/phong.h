// Exact Phong shading in real arithmetic: the reference for all errors.
#pragma once

#include <vector>

#include "model/scene/geometry.h"
#include "model/shading/linear.h"

namespace phongpipe {

// The unit vector between two unit vectors; zero, which has no highlight, where they are opposed
// but for rounding: looking straight into the light.
Vec3 halfway_vector(const Vec3& eye, const Vec3& to_light);

// Directions and colour of one light at one surface point.
struct Illumination {
  Vec3 light = Vec3::Zero();  // unit, surface → light
  Vec3 highlight =
      Vec3::Zero();  // unit halfway vector, or the eye vector where the highlight is R·V
  Color color = Color::Zero();  // after attenuation and spot factor
};

// v/|v|, or zero for a vector without direction.
Vec3 unit_or_zero(const Vec3& v);

// The cosine at the edge of a spotlight's cone.
double cone_cosine(const Light& light);

// Whether a point is inside the light's cone; true for lights other than spots. `unit_to_light`:
// surface → light.
bool in_cone(const Light& light, const Vec3& unit_to_light);

// `eye` is unit, `to_light` of true length.
Illumination illuminate(const Scene& scene, const Light& light, const Vec3& eye,
                        const Vec3& to_light);

// The reflection model for a normal of any length; not clamped, 1 is full scale:
// ambient_light·ambient + Σ color·(diffuse·max(0, N·L) + specular·max(0, N·H)^shininess where
// N·L > 0), or R·V in place of N·H.
Color reflect(const Scene& scene, const Material& material, const Vec3& normal,
              const std::vector<Illumination>& lights);

// One triangle under exact Phong shading: normal, eye and light vectors are interpolated linearly
// in screen space between the vertices and normalised at each pixel centre.
class PhongTriangle {
 public:
  PhongTriangle(const Scene& scene, const Material& material, const ScreenTriangle& triangle);

  // With depth cueing, a colour moves towards the cue colour by the distance along the view, which
  // is interpolated like the vectors. Overexposed colours fade from their unclamped value.
  //
  // Colours of `length` pixels from pixel (x, y) rightwards, in output LSB (0 to 255), not rounded.
  void shade(int x, int y, int length, Color* colors) const;

 private:
  Color cue(const Color& color, double x, double y) const;
  void illuminate_at(double x, double y, std::vector<Illumination>& lights) const;

  const Scene* scene_;
  const Material* material_;
  Linear<Vec3> normal_;
  Linear<Vec3> eye_;
  std::vector<Linear<Vec3>> to_light_;
  Linear<double> distance_;           // along the view, where there is depth cueing
  bool lights_vary_;                  // from pixel to pixel
  std::vector<Illumination> lights_;  // of every pixel, if they do not vary
};

}  // namespace phongpipe
