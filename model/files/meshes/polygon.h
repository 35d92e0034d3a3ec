// Cuts polygons into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

constexpr std::size_t kMaxPolygonCorners = 1024;  // the time grows with their square

// Triangles of a polygon of at least three corners, as indices of corners, all with the polygon's
// sense of rotation, by clipping ears of its projection along an axis, or else along its mean
// normal. Convex polygons become fans. It may touch itself, as where a cut leads to a hole and
// back. Nothing where its outline crosses itself.
std::optional<std::vector<std::array<std::uint32_t, 3>>> cut_polygon(
    const std::vector<Vec3>& corners);

}  // namespace phongpipe
