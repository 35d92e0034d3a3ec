#include "testbench/methods/visibility.h"

#include "testbench/accuracy/exact_visibility.h"

namespace phongpipe {
Visibility find_visible(const Scene& scene, const Geometry& geometry) {
  Visibility result;
  result.width = scene.image.width;
  result.height = scene.image.height;
  result.seen.assign(result.index(0, result.height), Visibility::kNothing);
  result.rows.resize(geometry.triangles.size());
  std::vector<BoundedDepth> depths(result.seen.size());
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    std::vector<RowSpan>& rows = result.rows[t];
    cover(geometry.triangles[t], result.width, result.height, rows);
    if (rows.empty()) continue;
    ++result.triangles;
    const ExactDepth depth(geometry.triangles[t]);
    for (const RowSpan& row : rows) {
      ++result.spans;
      result.shaded += static_cast<std::size_t>(row.length);
      for (int x = row.x; x < row.x + row.length; ++x) {
        const BoundedDepth here = depth.at(x, row.y);
        const std::size_t index = result.index(x, row.y);
        const bool first = result.seen[index] == Visibility::kNothing;
        if (!first && !here.is_nearer_than(depths[index])) continue;
        depths[index] = here;
        result.seen[index] = t;
      }
    }
  }
  return result;
}

}  // namespace phongpipe
