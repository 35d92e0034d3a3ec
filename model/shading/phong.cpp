#include "model/shading/phong.h"

#include <algorithm>
#include <cmath>

#include "model/shading/exact_power.h"
#include "model/shading/screen_interpolator.h"

namespace phongpipe {
namespace {

constexpr double kDegrees = 3.14159265358979323846 / 180;

// 1/(c + l d + q d²), times the spot's cone.
double falloff(const Light& light, const Vec3& unit_to_light, double distance) {
  const double attenuation = distance_attenuation(light, distance);
  if (light.type != LightType::spot) return attenuation;
  if (!in_cone(light, unit_to_light)) return 0;
  return attenuation * std::pow(-unit_to_light.dot(light.direction), light.spot_exponent);
}

Vec3 at(const Linear<Vec3>& q, double x, double y) {
  return q.a * x + q.b * y + q.c;
}

}  // namespace

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

double cone_cosine(const Light& light) {
  return std::cos(light.spot_cutoff_degrees * kDegrees);
}

Vec3 halfway_vector(const Vec3& eye, const Vec3& to_light) {
  constexpr double kOpposed = 1e-6;
  const Vec3 sum = eye + to_light;
  const double length = sum.norm();
  return length > kOpposed ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

bool in_cone(const Light& light, const Vec3& unit_to_light) {
  if (light.type != LightType::spot) return true;
  const double cosine = std::max(0.0, -unit_to_light.dot(light.direction));
  return cosine >= cone_cosine(light);
}

Illumination illuminate(const Scene& scene, const Light& light, const Vec3& eye,
                        const Vec3& to_light) {
  Illumination result;
  result.light = unit_or_zero(to_light);
  result.highlight =
      scene.shading.highlight == Highlight::halfway ? halfway_vector(eye, result.light) : eye;
  result.color = falloff(light, result.light, to_light.norm()) * light.color;
  return result;
}

Color reflect(const Scene& scene, const Material& material, const Vec3& normal,
              const std::vector<Illumination>& lights) {
  const Vec3 n = normal.normalized();
  Color sum = scene.shading.ambient_light * material.ambient;
  for (const Illumination& light : lights) {
    const double n_dot_l = n.dot(light.light);
    if (!(n_dot_l > 0)) continue;
    double cosine = n.dot(light.highlight);
    if (scene.shading.highlight == Highlight::reflection) {  // R·V, R = 2(N·L)N − L
      cosine = 2 * n_dot_l * cosine - light.light.dot(light.highlight);
    }
    const double power = exact_power(std::max(0.0, cosine), material.shininess);
    sum += light.color * (material.diffuse * n_dot_l + material.specular * power);
  }
  return sum;
}

PhongTriangle::PhongTriangle(const Scene& scene, const Material& material,
                             const ScreenTriangle& triangle)
    : scene_(&scene), material_(&material) {
  const auto& v = triangle.vertices;
  const Interpolator<double> interpolate = screen_interpolator(triangle);
  normal_ = interpolate(v[0].normal, v[1].normal, v[2].normal);
  eye_ = interpolate(v[0].eye, v[1].eye, v[2].eye);
  lights_vary_ = scene.shading.viewer == Viewer::local;
  for (const Light& light : scene.lights) {
    to_light_.push_back(interpolate(light_vector(light, v[0]), light_vector(light, v[1]),
                                    light_vector(light, v[2])));
    lights_vary_ = lights_vary_ || light.type != LightType::directional;
  }
  if (!lights_vary_) illuminate_at(0, 0, lights_);
  if (scene.depth_cue) {
    distance_ = interpolate(view_distance(scene, v[0]), view_distance(scene, v[1]),
                            view_distance(scene, v[2]));
  }
}

Color PhongTriangle::cue(const Color& color, double x, double y) const {
  const DepthCue& cue = *scene_->depth_cue;
  const double distance = distance_.a * x + distance_.b * y + distance_.c;
  const double own = std::clamp((cue.far - distance) / (cue.far - cue.near), 0.0, 1.0);
  return cue.color + (color - cue.color) * own;
}

void PhongTriangle::illuminate_at(double x, double y, std::vector<Illumination>& lights) const {
  const Vec3 eye = unit_or_zero(at(eye_, x, y));
  lights.clear();
  for (std::size_t i = 0; i < to_light_.size(); ++i) {
    lights.push_back(illuminate(*scene_, scene_->lights[i], eye, at(to_light_[i], x, y)));
  }
}

void PhongTriangle::shade(int x, int y, int length, Color* colors) const {
  std::vector<Illumination> varying;
  for (int i = 0; i < length; ++i) {
    const double px = x + i + 0.5, py = y + 0.5;
    if (lights_vary_) illuminate_at(px, py, varying);
    Color color =
        reflect(*scene_, *material_, at(normal_, px, py), lights_vary_ ? varying : lights_);
    if (scene_->depth_cue) color = cue(color, px, py);
    colors[i] = color.max(0).min(1) * 255;
  }
}

}  // namespace phongpipe
