#include "testbench/methods/real_frame.h"

#include "model/fixed/constants.h"
#include "model/shading/phong.h"
#include "testbench/methods/best_triangle.h"

namespace phongpipe {
namespace {

// Calls shader_of(triangle) for each triangle that covers a pixel, its shade(x, y, length, colors)
// for each row, and keeps the colours of what is seen.
template <typename ShaderOf>
std::vector<Color> render(const Scene& scene, const Geometry& geometry,
                          const Visibility& visibility, ShaderOf shader_of) {
  std::vector<Color> colors(visibility.seen.size(), scene.image.background * kOutputMax);
  std::vector<Color> row_colors;
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    if (visibility.rows[t].empty()) continue;
    auto&& shader = shader_of(t);
    for (const RowSpan& row : visibility.rows[t]) {
      row_colors.resize(std::max(row_colors.size(), static_cast<std::size_t>(row.length)));
      shader.shade(row.x, row.y, row.length, row_colors.data());
      const std::size_t first = visibility.index(row.x, row.y);
      for (std::size_t i = 0; i < static_cast<std::size_t>(row.length); ++i) {
        if (visibility.seen[first + i] == t) colors[first + i] = row_colors[i];
      }
    }
  }
  return colors;
}

}  // namespace

std::vector<Color> render_phong(const Scene& scene, const Geometry& geometry,
                                const Visibility& visibility) {
  return render(scene, geometry, visibility, [&](std::uint32_t t) {
    const ScreenTriangle& triangle = geometry.triangles[t];
    return PhongTriangle(scene, geometry.materials[triangle.material], triangle);
  });
}

std::vector<Color> render_best(const Scene& scene, const Geometry& geometry,
                               const Visibility& visibility) {
  return render(scene, geometry, visibility, [&](std::uint32_t t) {
    const ScreenTriangle& triangle = geometry.triangles[t];
    return BestTriangle(scene, geometry.materials[triangle.material], triangle, visibility.rows[t]);
  });
}

MethodFrame render_method(const Scene& scene, const Geometry& geometry,
                          const Visibility& visibility, const ShadingMethod& method,
                          PowerKind power) {
  std::vector<Power> powers;
  for (const Material& material : geometry.materials)
    powers.emplace_back(power, material.shininess);
  MethodFrame frame;
  std::unique_ptr<TriangleShader> shader;
  const auto count_exact = [&] {
    if (shader) frame.exact_spans += static_cast<std::size_t>(shader->exact_spans());
  };
  frame.colors = render(scene, geometry, visibility, [&](std::uint32_t t) -> TriangleShader& {
    const ScreenTriangle& triangle = geometry.triangles[t];
    const Pixel origin = expansion_pixel(triangle, visibility.rows[t]);
    count_exact();
    shader = method.create({scene, geometry.materials[triangle.material], triangle,
                            powers[triangle.material], origin.x, origin.y});
    return *shader;
  });
  count_exact();
  return frame;
}

}  // namespace phongpipe
