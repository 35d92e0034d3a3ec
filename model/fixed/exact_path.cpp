#include "model/fixed/exact_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/fixed/coverage.h"
#include "model/shading/phong.h"
#include "model/shading/screen_interpolator.h"

namespace phongpipe {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;

// A vector that is linear over the triangle, stepped along a row.
class SteppedVector {
 public:
  SteppedVector(const Linear<Vec3>& field, const Corners<double>& corners) : field_(field) {
    for (const Vec3& corner : corners) largest_ = std::max(largest_, corner.norm());
  }
  void start(double x, double y) { value_ = field_.a * x + (field_.b * y + field_.c); }
  void advance() { value_ += field_.a; }
  const Vec3& value() const { return value_; }
  // By how much the direction may be off, if the vector is off by `noise` of the longest corner.
  double doubt(double noise) const {
    const double length = value_.norm();
    return length > 0 ? noise * largest_ / length : 1;
  }

 private:
  Linear<Vec3> field_;
  double largest_ = 0;
  Vec3 value_ = Vec3::Zero();
};

// What rounding may do to interpolated vectors, here and in the exact Phong shading that errors are
// measured against, as a share of the longest corner: some ten roundings of terms as large as the
// gradient of the barycentric coordinates times the farthest coordinate of the triangle.
// Every step along a row adds another.
double interpolation_noise(const ScreenTriangle& triangle, const Interpolator<double>& interpolate,
                           int longest_row) {
  const double roundings = 16 + longest_row;
  double farthest = 0;
  for (const ScreenVertex& vertex : triangle.vertices) {
    farthest = std::max({farthest, std::fabs(in_pixels(vertex.x)), std::fabs(in_pixels(vertex.y))});
  }
  const Linear<double> u = interpolate.coordinate_1(), v = interpolate.coordinate_2();
  const double gradient = std::fabs(u.a) + std::fabs(u.b) + std::fabs(v.a) + std::fabs(v.b);
  return roundings * kUnit * (1 + gradient * farthest);
}

// Largest change of a pixel, in LSB, if directions are off by `doubt`.
double change_of_pixel(const ExactLight<double>& light, const ExactPoint<double>& point,
                       double cutoff, double doubt) {
  if (doubt >= 1) return kOutputMax;
  const auto largest = [](const std::array<double, 3>& c) {
    return *std::max_element(c.begin(), c.end());
  };
  const double diffuse = largest(light.diffuse) * point.attenuation;
  const double specular =
      light.form.wanted.highlight ? largest(light.specular) * point.attenuation : 0;
  if (light.cone && std::fabs(point.cosines.spot - cutoff) <= doubt) return diffuse + specular;
  // Of H, where light and eye are nearly opposed.
  double bent = doubt;
  const bool varies = light.form.point_light || light.form.local_viewer;
  if (varies && light.form.highlight == Highlight::halfway) {
    const double square = 2 * (1 + point.cosines.light_eye);
    const bool lit = point.reflected.light > -doubt;
    if (square < 2 * kLeastHalfway) return diffuse * doubt + (lit ? specular : 0);
    bent = doubt * (1 + 4 / square);
  }
  const double n = light.shininess;
  const double base = std::clamp(point.reflected.highlight, 0.0, 1.0);
  if (std::fabs(point.reflected.light) <= doubt) {
    return doubt * diffuse + specular * std::pow(std::min(1.0, base + bent), n);
  }
  if (point.reflected.light < 0) return 0;
  // Below an exponent of 1 the power is steepest where it is least, and 0 for what is below 0.
  const bool dark = point.reflected.highlight + bent <= 0;
  const double power = dark              ? 0
                       : n >= 1          ? n * bent
                       : base > 2 * bent ? n * std::pow(base - bent, n - 1) * bent
                                         : std::pow(base + bent, n);
  const double fading = doubt * (1 + light.terms.spot_exponent);
  return diffuse * (doubt + fading) + specular * (n == 0 ? 0 : power + fading);
}

class TriangleShader {
 public:
  TriangleShader(const FrameSetup& frame, const ScreenTriangle& triangle, int longest_row)
      : frame_(frame),
        scene_(*frame.scene),
        lights_(exact_lights(frame, frame.geometry->materials[triangle.material])),
        interpolate_(screen_interpolator(triangle)),
        noise_(interpolation_noise(triangle, interpolate_, longest_row)),
        normal_(stepped([&](std::size_t i) { return triangle.vertices[i].normal; })),
        eye_(stepped([&](std::size_t i) { return triangle.vertices[i].eye; })) {
    const Material& material = frame.geometry->materials[triangle.material];
    const Color ambient = kOutputMax * scene_.shading.ambient_light * material.ambient;
    for (std::size_t c = 0; c < 3; ++c) ambient_[c] = ambient[static_cast<Eigen::Index>(c)];
    for (const Light& light : scene_.lights) {
      to_light_.push_back(
          stepped([&](std::size_t i) { return light_vector(light, triangle.vertices[i]); }));
      cutoff_.push_back(cone_cosine(light));
    }
    if (!scene_.depth_cue) return;
    const auto& v = triangle.vertices;
    distance_ = interpolate_(view_distance(scene_, v[0]), view_distance(scene_, v[1]),
                             view_distance(scene_, v[2]));
    cue_noise_ = 2 * kOutputMax * cue_share_noise(scene_, triangle);
    for (std::size_t c = 0; c < 3; ++c) {
      cue_[c] = kOutputMax * scene_.depth_cue->color[static_cast<Eigen::Index>(c)];
    }
  }

  void shade(const RowSpan& row, ExactPixels& result) {
    const double x = row.x + 0.5, y = row.y + 0.5;
    normal_.start(x, y);
    eye_.start(x, y);
    for (SteppedVector& light : to_light_) light.start(x, y);
    for (int i = 0; i < row.length; ++i) {
      result.values.push_back(pixel(x + i, y, result.refused));
      normal_.advance();
      eye_.advance();
      for (SteppedVector& light : to_light_) light.advance();
    }
  }

 private:
  template <typename VectorAt>
  SteppedVector stepped(const VectorAt& vector_at) const {
    const Corners<double> corners = {vector_at(0), vector_at(1), vector_at(2)};
    return {interpolate_(corners[0], corners[1], corners[2]), corners};
  }

  std::array<std::int64_t, 3> pixel(double x, double y, std::uint32_t& refused) const {
    std::array<double, 3> color = ambient_;
    const int channels = frame_.configuration.channels;
    double change = cue_noise_;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const ExactLight<double>& light = lights_[i];
      const bool near = light.form.point_light, local = light.form.local_viewer;
      PointVectors<double> at;
      at.normal = normal_.value();
      at.light = near ? to_light_[i].value() : light.terms.to_light;
      at.eye = local ? eye_.value() : light.terms.eye;
      double doubt = normal_.doubt(noise_);
      if (near) doubt += to_light_[i].doubt(noise_);
      if (local) doubt += eye_.doubt(noise_);
      if (at.normal.squaredNorm() == 0) {  // has no direction: neither lit nor proved
        change = kOutputMax;
        continue;
      }
      const ExactPoint<double> point = exact_point(light, at);
      change += change_of_pixel(light, point, cutoff_[i], doubt);
      if (light.cone && !(std::max(0.0, point.cosines.spot) >= cutoff_[i])) continue;
      if (point.reflected.light > 0) add_light(light, point, channels, color);
    }
    if (change > kExactPathNoise) ++refused;
    if (scene_.depth_cue) {
      const DepthCue& cue = *scene_.depth_cue;
      const double distance = distance_.a * x + distance_.b * y + distance_.c;
      fade_to_cue(cue_, std::clamp((cue.far - distance) / (cue.far - cue.near), 0.0, 1.0), channels,
                  color);
    }
    std::array<std::int64_t, 3> registers{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      const double value = std::clamp(color[c], 0.0, static_cast<double>(kOutputMax));
      registers[c] =
          std::llround(std::ldexp(value + 0.5, frame_.configuration.diffuse_fraction_bits));
    }
    return registers;
  }

  const FrameSetup& frame_;
  const Scene& scene_;
  std::vector<ExactLight<double>> lights_;
  Interpolator<double> interpolate_;
  double noise_;
  SteppedVector normal_, eye_;
  std::vector<SteppedVector> to_light_;
  std::vector<double> cutoff_;  // cosine at the edge of the cone
  std::array<double, 3> ambient_{}, cue_{};
  Linear<double> distance_{};  // along the view, with depth cueing
  double cue_noise_ = 0;       // LSB
};

}  // namespace

std::vector<ExactLight<double>> exact_lights(const FrameSetup& frame, const Material& material) {
  const auto index = static_cast<std::uint32_t>(&material - frame.geometry->materials.data());
  std::vector<ExactLight<double>> lights;
  for (std::uint32_t pass = 0; pass < frame.passes; ++pass) {
    const Light& source = frame.scene->lights[pass];
    const MaterialSetup& setup = frame.material(pass, index);
    ExactLight<double> light;
    light.form = setup.plan.form;
    // What does not change with distance belongs to the colour.
    const double constant = is_attenuated(source) ? 1 : distance_attenuation(source, 0);
    const Color specular = kOutputMax * constant * material.specular * source.color;
    const Color diffuse = kOutputMax * constant * material.diffuse * source.color;
    light.form.wanted.highlight = (specular > 0).any();
    light.form.local_viewer =
        light.form.wanted.highlight && frame.scene->shading.viewer == Viewer::local;
    light.cone = source.type == LightType::spot;
    light.terms = setup.light.terms;
    light.terms.attenuation = source.attenuation;
    light.shininess = material.shininess;
    for (std::size_t c = 0; c < 3; ++c) {
      light.diffuse[c] = diffuse[static_cast<Eigen::Index>(c)];
      light.specular[c] = specular[static_cast<Eigen::Index>(c)];
    }
    lights.push_back(light);
  }
  return lights;
}

ExactPixels shade_exactly(const FrameSetup& frame, const ScreenTriangle& triangle,
                          const std::vector<RowSpan>& rows) {
  ExactPixels result;
  TriangleShader shader(frame, triangle, longest_row(rows));
  for (const RowSpan& row : rows) shader.shade(row, result);
  return result;
}

std::vector<RowSpan> one_pixel_rows(const std::vector<RowSpan>& rows) {
  std::vector<RowSpan> pixels;
  std::int32_t place = 0;
  for (const RowSpan& row : rows) {
    for (int i = 0; i < row.length; ++i) pixels.push_back({row.x + i, row.y, 1, true, place++});
  }
  return pixels;
}

double cue_share_noise(const Scene& scene, const ScreenTriangle& triangle) {
  if (!scene.depth_cue) return 0;
  const DepthCue& cue = *scene.depth_cue;
  double farthest = std::fabs(cue.far);
  for (const ScreenVertex& vertex : triangle.vertices) {
    farthest = std::max(farthest, std::fabs(view_distance(scene, vertex)));
  }
  constexpr double kRoundings = 32;
  return kRoundings * kUnit * farthest / (cue.far - cue.near);
}

}  // namespace phongpipe
