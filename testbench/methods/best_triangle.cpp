#include "testbench/methods/best_triangle.h"

#include <algorithm>
#include <cmath>

#include "model/fixed/constants.h"
#include "model/shading/quadratics/best_quadratic.h"
#include "model/shading/screen_interpolator.h"

namespace phongpipe {
namespace {

// Every so many pixels and rows, that there are about so many samples at most; always to the ends,
// as the extremes of an error lie at the rim or are broad.
constexpr std::size_t kSamples = 1000;

int stride_of(const std::vector<RowSpan>& rows) {
  std::size_t pixels = 0;
  for (const RowSpan& row : rows) pixels += static_cast<std::size_t>(row.length);
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pixels) / kSamples)));
}

template <typename Visit>
void for_samples(int count, int stride, Visit visit) {
  for (int i = 0; i < count - 1; i += stride) visit(i);
  visit(count - 1);
}

double highlight_cosine(const Scene& scene, const Vec3& normal, const Illumination& light) {
  const double cosine = normal.dot(light.highlight);
  if (scene.shading.highlight == Highlight::halfway) return cosine;
  return 2 * normal.dot(light.light) * cosine - light.light.dot(light.highlight);
}

}  // namespace

BestTriangle::BestTriangle(const Scene& scene, const Material& material,
                           const ScreenTriangle& triangle, const std::vector<RowSpan>& rows)
    : scene_(scene), material_(material), origin_x_(rows.front().x), origin_y_(rows.front().y) {
  const auto& v = triangle.vertices;
  std::array<double, 3> corner_x, corner_y;
  for (std::size_t i = 0; i < 3; ++i) {
    corner_x[i] = in_pixels(v[i].x) - (origin_x_ + 0.5);
    corner_y[i] = in_pixels(v[i].y) - (origin_y_ + 0.5);
  }
  const Interpolator<double> interpolate(corner_x, corner_y);
  const Linear<double> u = interpolate.coordinate_1(), w = interpolate.coordinate_2();
  const BarycentricBasis<double> basis(u, w);
  const Linear<Vec3> normal = interpolate(v[0].normal, v[1].normal, v[2].normal);
  eye_ = interpolate(v[0].eye, v[1].eye, v[2].eye);

  const int stride = stride_of(rows);
  const bool shiny = is_shiny(material);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    to_light_.push_back(interpolate(light_vector(scene.lights[i], v[0]),
                                    light_vector(scene.lights[i], v[1]),
                                    light_vector(scene.lights[i], v[2])));
    std::vector<CosineSample> light, highlight;
    for_samples(static_cast<int>(rows.size()), stride, [&](int row) {
      const RowSpan& span = rows[static_cast<std::size_t>(row)];
      for_samples(span.length, stride, [&](int pixel) {
        const double x = span.x + pixel - origin_x_, y = span.y - origin_y_;
        const Vec3 n = (normal.a * x + normal.b * y + normal.c).normalized();
        const Illumination at = illuminate_at(i, x, y);
        const double along_u = u.a * x + u.b * y + u.c, along_w = w.a * x + w.b * y + w.c;
        light.push_back({along_u, along_w, n.dot(at.light)});
        highlight.push_back({along_u, along_w, highlight_cosine(scene, n, at)});
      });
    });
    // Errors far below what anybody sees need no more iterations.
    constexpr double kUnseen = 0.01 / kOutputMax;
    Series series = {};
    series.light = basis(best_quadratic(light, 1, kUnseen).values);
    if (shiny) {
      series.highlight = basis(best_quadratic(highlight, material.shininess, kUnseen).values);
    }
    series_.push_back(series);
  }
}

Illumination BestTriangle::illuminate_at(std::size_t light, double x, double y) const {
  const auto at = [&](const Linear<Vec3>& q) { return Vec3(q.a * x + q.b * y + q.c); };
  return illuminate(scene_, scene_.lights[light], at(eye_).normalized(), at(to_light_[light]));
}

void BestTriangle::shade(int x, int y, int length, Color* colors) const {
  for (int i = 0; i < length; ++i) {
    const double px = x + i - origin_x_, py = y - origin_y_;
    Color sum = scene_.shading.ambient_light * material_.ambient;
    for (std::size_t k = 0; k < series_.size(); ++k) {
      const double n_dot_l = series_[k].light(px, py);
      if (!(n_dot_l > 0)) continue;
      const double cosine = std::clamp(series_[k].highlight(px, py), 0.0, 1.0);
      sum += illuminate_at(k, px, py).color *
             (material_.diffuse * n_dot_l +
              material_.specular * std::pow(cosine, material_.shininess));
    }
    colors[i] = sum.max(0).min(1) * kOutputMax;
  }
}

}  // namespace phongpipe
