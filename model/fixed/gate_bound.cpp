#include "model/fixed/gate_bound.h"

#include <algorithm>

#include "model/fixed/rounding_bound.h"

namespace phongpipe {
namespace {

// Largest side of the triangle's bounding box, in pixels, and that of the image if it is smaller.
int extent_of(const ScreenTriangle& triangle, const Image& image) {
  const auto& v = triangle.vertices;
  const auto side = [](std::int32_t a, std::int32_t b, std::int32_t c, int size) {
    const auto [low, high] = std::minmax({a, b, c});
    return std::min(size, static_cast<int>(in_pixels(high - low)) + 1);
  };
  return std::max(side(v[0].x, v[1].x, v[2].x, image.width),
                  side(v[0].y, v[1].y, v[2].y, image.height));
}

}  // namespace

bool diffuse_loses_sign(const FixedPointFormats& formats, const Scene& scene,
                        const Geometry& geometry, const Material& material, const Light& light) {
  // Any channel opens the gate: the darkest that is lit decides.
  const Color scales = kOutputMax * material.diffuse * light.color;
  const auto channels = formats.channel_choice == ChannelChoice::one ? 1 : 3;
  const double scale = (scales > 0).select(scales, kOutputMax).head(channels).minCoeff();
  // The largest |N·L| whose sign may be wrong.
  const auto doubtful = [&](int extent) {
    return rounding_bound(formats, formats.diffuse_fraction_bits, extent, extent) / scale;
  };
  if (doubtful(std::max(scene.image.width, scene.image.height)) <= kGateTolerance) return false;
  return std::any_of(
      geometry.triangles.begin(), geometry.triangles.end(), [&](const ScreenTriangle& triangle) {
        if (&geometry.materials[triangle.material] != &material) return false;
        const double band = doubtful(extent_of(triangle, scene.image));
        if (band <= kGateTolerance) return false;
        double least = 1, most = -1;
        for (const ScreenVertex& vertex : triangle.vertices) {
          const double cosine =
              vertex.normal.normalized().dot(light_vector(light, vertex).normalized());
          least = std::min(least, cosine);
          most = std::max(most, cosine);
        }
        return most > 0 && least < band;
      });
}

}  // namespace phongpipe
