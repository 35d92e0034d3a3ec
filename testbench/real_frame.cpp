#include "testbench/real_frame.h"

#include <limits>

#include "model/fixed/coverage.h"
#include "model/scene/input_error.h"
#include "model/shading/phong.h"
#include "testbench/error_chain.h"

namespace phongpipe {
namespace {

std::vector<Color> background(const Scene& scene) {
  const auto pixels =
      static_cast<std::size_t>(scene.image.width) * static_cast<std::size_t>(scene.image.height);
  return std::vector<Color>(pixels, scene.image.background * kOutputMax);
}

Linear<double> depth_of(const ScreenTriangle& triangle) {
  const auto& v = triangle.vertices;
  const auto pixels = [](std::int32_t q) { return q / static_cast<double>(kSubpixels); };
  const Interpolator<double> interpolate({pixels(v[0].x), pixels(v[1].x), pixels(v[2].x)},
                                         {pixels(v[0].y), pixels(v[1].y), pixels(v[2].y)});
  return interpolate(v[0].z, v[1].z, v[2].z);
}

}  // namespace

std::vector<Color> render_phong(const Scene& scene, const Geometry& geometry) {
  if (scene.depth_cue) {
    throw InputError(scene.file, 0, "depth cueing is not rendered yet; leave [depth_cue] out");
  }
  std::vector<Color> colors = background(scene);
  std::vector<double> depths(colors.size(), std::numeric_limits<double>::infinity());
  std::vector<RowSpan> rows;
  std::vector<Color> row_colors;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    cover(triangle, scene.image.width, scene.image.height, rows);
    if (rows.empty()) continue;
    const Linear<double> depth = depth_of(triangle);
    const PhongTriangle phong(scene, geometry.materials[triangle.material], triangle);
    for (const RowSpan& row : rows) {
      row_colors.resize(std::max(row_colors.size(), static_cast<std::size_t>(row.length)));
      phong.shade(row.x, row.y, row.length, row_colors.data());
      const std::size_t first =
          static_cast<std::size_t>(row.y) * static_cast<std::size_t>(scene.image.width) +
          static_cast<std::size_t>(row.x);
      for (std::size_t i = 0; i < static_cast<std::size_t>(row.length); ++i) {
        const double z =
            depth.a * (row.x + static_cast<double>(i) + 0.5) + depth.b * (row.y + 0.5) + depth.c;
        if (z >= depths[first + i]) continue;
        depths[first + i] = z;
        colors[first + i] = row_colors[i];
      }
    }
  }
  return colors;
}

std::vector<Color> render_taylor(const Scene& scene, const Geometry& geometry,
                                 const FrameSetup& frame) {
  std::vector<Color> colors = background(scene);
  const ModelFrame model = run_model(frame, geometry);
  for_each_visible_pixel(scene, geometry, frame, model, [&](const ErrorChain& links) {
    colors[links.index] = links.polynomial;
    if (frame.configuration.channels == 1)
      colors[links.index] = Color::Constant(links.polynomial[0]);
  });
  return colors;
}

}  // namespace phongpipe
