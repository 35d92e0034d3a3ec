#include "model/fixed/coverage.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace phongpipe {
namespace {

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {  // b > 0
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}
std::int64_t ceil_divide(std::int64_t a, std::int64_t b) {
  return -floor_divide(-a, b);
}

// Inside where a·x + b·y + c ≥ 0, in subpixels; the top-left rule is folded into c.
struct Edge {
  std::int64_t a, b, c;

  Edge(const ScreenVertex& from, const ScreenVertex& to)
      : a(std::int64_t{from.y} - to.y), b(std::int64_t{to.x} - from.x) {
    const bool top = a == 0 && b > 0;
    const bool left = a > 0;  // goes up
    c = -a * from.x - b * from.y - (top || left ? 0 : 1);
  }
};

constexpr std::int64_t centre(int pixel) {
  return std::int64_t{pixel} * kSubpixels + kSubpixels / 2;
}

// First pixel whose centre is at or beyond `subpixel`.
int first_pixel(std::int64_t subpixel) {
  return static_cast<int>(ceil_divide(subpixel - kSubpixels / 2, kSubpixels));
}

}  // namespace

void cover(const ScreenTriangle& triangle, int width, int height, std::vector<RowSpan>& rows) {
  rows.clear();
  const ScreenVertex* v[3] = {&triangle.vertices[0], &triangle.vertices[1], &triangle.vertices[2]};
  const std::int64_t doubled_area =
      (std::int64_t{v[1]->x} - v[0]->x) * (std::int64_t{v[2]->y} - v[0]->y) -
      (std::int64_t{v[2]->x} - v[0]->x) * (std::int64_t{v[1]->y} - v[0]->y);
  if (doubled_area == 0) return;
  if (doubled_area < 0) std::swap(v[1], v[2]);
  const std::array<Edge, 3> edges = {Edge(*v[0], *v[1]), Edge(*v[1], *v[2]), Edge(*v[2], *v[0])};

  const auto [x_low, x_high] = std::minmax({v[0]->x, v[1]->x, v[2]->x});
  const auto [y_low, y_high] = std::minmax({v[0]->y, v[1]->y, v[2]->y});
  const std::int64_t left = std::max(0, first_pixel(x_low));
  const std::int64_t right = std::min(width - 1, first_pixel(x_high));
  const int bottom = std::min(height - 1, first_pixel(y_high));
  for (int y = std::max(0, first_pixel(y_low)); y <= bottom; ++y) {
    std::int64_t from = left, to = right;
    for (const Edge& edge : edges) {
      // a·(kSubpixels x + kSubpixels/2) + rest ≥ 0
      const std::int64_t rest = edge.a * (kSubpixels / 2) + edge.b * centre(y) + edge.c;
      const std::int64_t slope = edge.a * kSubpixels;
      if (slope > 0) {
        from = std::max(from, ceil_divide(-rest, slope));
      } else if (slope < 0) {
        to = std::min(to, floor_divide(rest, -slope));
      } else if (rest < 0) {
        to = from - 1;
      }
    }
    if (from <= to) {
      rows.push_back({static_cast<int>(from), y, static_cast<int>(to - from + 1)});
    }
  }
}

bool covers_a_pixel(const Scene& scene, const Geometry& geometry) {
  std::vector<RowSpan> rows;
  const auto covers = [&](const ScreenTriangle& triangle) {
    cover(triangle, scene.image.width, scene.image.height, rows);
    return !rows.empty();
  };
  return std::any_of(geometry.triangles.begin(), geometry.triangles.end(), covers);
}

InputError nothing_covered(const Scene& scene) {
  return {scene.source, 0,
          "nothing of the scene covers a pixel; look at the camera and the objects"};
}

int longest_row(const std::vector<RowSpan>& rows) {
  int longest = 0;
  for (const RowSpan& row : rows) longest = std::max(longest, row.length);
  return longest;
}

Pixel expansion_pixel(const ScreenTriangle& triangle, const std::vector<RowSpan>& rows) {
  const auto& v = triangle.vertices;
  // Three times the centroid, so that all is whole.
  const std::int64_t x3 = std::int64_t{v[0].x} + v[1].x + v[2].x;
  const std::int64_t y3 = std::int64_t{v[0].y} + v[1].y + v[2].y;
  const int nearest_x = static_cast<int>(floor_divide(x3, std::int64_t{3} * kSubpixels));
  Pixel best;
  std::int64_t best_distance = -1;
  for (const RowSpan& row : rows) {
    const int x = std::clamp(nearest_x, row.x, row.x + row.length - 1);
    const std::int64_t dx = 3 * centre(x) - x3, dy = 3 * centre(row.y) - y3;
    const std::int64_t distance = dx * dx + dy * dy;
    if (best_distance < 0 || distance < best_distance) {
      best = {x, row.y};
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace phongpipe
