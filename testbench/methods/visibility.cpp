#include "testbench/methods/visibility.h"

#include <limits>

#include "model/shading/screen_interpolator.h"

namespace phongpipe {
namespace {

Linear<double> depth_of(const ScreenTriangle& triangle) {
  const auto& v = triangle.vertices;
  return screen_interpolator(triangle)(v[0].z, v[1].z, v[2].z);
}

}  // namespace

Visibility find_visible(const Scene& scene, const Geometry& geometry) {
  Visibility result;
  result.width = scene.image.width;
  result.height = scene.image.height;
  result.seen.assign(result.index(0, result.height), Visibility::kNothing);
  result.rows.resize(geometry.triangles.size());
  std::vector<double> depths(result.seen.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    std::vector<RowSpan>& rows = result.rows[t];
    cover(geometry.triangles[t], result.width, result.height, rows);
    if (rows.empty()) continue;
    ++result.triangles;
    const Linear<double> depth = depth_of(geometry.triangles[t]);
    for (const RowSpan& row : rows) {
      ++result.spans;
      result.shaded += static_cast<std::size_t>(row.length);
      for (int x = row.x; x < row.x + row.length; ++x) {
        const double z = depth.a * (x + 0.5) + depth.b * (row.y + 0.5) + depth.c;
        const std::size_t index = result.index(x, row.y);
        if (z >= depths[index]) continue;
        depths[index] = z;
        result.seen[index] = t;
      }
    }
  }
  return result;
}

}  // namespace phongpipe
