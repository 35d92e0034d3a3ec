#include "model/fixed/cone.h"

#include <algorithm>

#include "model/shading/phong.h"
#include "model/shading/screen_interpolator.h"

namespace phongpipe {

void split_at_cone(const Light& light, const ScreenTriangle& triangle, std::vector<RowSpan>& rows) {
  if (light.type != LightType::spot) return;
  // As exact Phong shading does it, to the last bit.
  const auto inside = [&light](const Vec3& to_light) {
    return in_cone(light, unit_or_zero(to_light));
  };
  // Corners that are well inside: all pixels are.
  constexpr double kMarginDegrees = 1e-6;
  Light narrower = light;
  narrower.spot_cutoff_degrees -= kMarginDegrees;
  const auto& v = triangle.vertices;
  if (std::all_of(v.begin(), v.end(), [&](const ScreenVertex& vertex) {
        const Vec3 to_light = light_vector(light, vertex);
        return to_light.norm() > 0 && in_cone(narrower, to_light.normalized());
      })) {
    return;
  }
  const Linear<Vec3> to_light = screen_interpolator(triangle)(
      light_vector(light, v[0]), light_vector(light, v[1]), light_vector(light, v[2]));
  std::vector<RowSpan> pieces;
  for (const RowSpan& row : rows) {
    for (int x = row.x; x < row.x + row.length; ++x) {
      const bool lit = inside(to_light.a * (x + 0.5) + to_light.b * (row.y + 0.5) + to_light.c);
      if (x == row.x || lit != pieces.back().lit) pieces.push_back({x, row.y, 0, lit});
      ++pieces.back().length;
    }
  }
  rows = std::move(pieces);
}

}  // namespace phongpipe
