// Triangles of points in subpixels, how often they cover each pixel of an image, and how often they
// must.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "model/fixed/coverage.h"
#include "testbench/system/random.h"

namespace phongpipe {

struct Point {  // subpixels
  int x, y;
};

constexpr int centre(int pixel) {
  return pixel * kSubpixels + kSubpixels / 2;
}

inline ScreenTriangle triangle_of(Point p, Point q, Point r) {
  ScreenTriangle triangle;
  const std::array<Point, 3> corners = {p, q, r};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.vertices[i].x = corners[i].x;
    triangle.vertices[i].y = corners[i].y;
  }
  return triangle;
}

// Half of all points fall on pixel centres or edges between pixels, where the rule decides.
inline Point random_point(Random& random, int low, int high) {
  const int grid = random.integer(0, 1) == 0 ? 1 : kSubpixels / 2;
  const auto coordinate = [&] {
    return random.integer(low * kSubpixels / grid, high * kSubpixels / grid) * grid;
  };
  const int x = coordinate();
  return {x, coordinate()};
}

// How often the polygon goes round the pixel's centre, positive as signed_area is. The centre is
// moved by (ε, ε²): right of what it lies on, and below where that is horizontal. That is the
// top-left rule, told without edge functions.
inline int windings(const std::vector<Point>& polygon, int x, int y) {
  const std::int64_t px = centre(x), py = centre(y);
  int result = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y <= py) == (b.y <= py)) continue;
    const int turn = a.y < b.y ? 1 : -1;
    if (turn < 0) std::swap(a, b);
    const std::int64_t left = (px - a.x) * (std::int64_t{b.y} - a.y);
    if (left < (py - a.y) * (std::int64_t{b.x} - a.x)) result += turn;
  }
  return result;
}

inline bool contains(const std::vector<Point>& polygon, int x, int y) {
  return windings(polygon, x, y) != 0;
}

class CoverageCounter {
 public:
  CoverageCounter(int width, int height) : width_(width), height_(height), counts_(at(0, height)) {}
  // What it covers counts as `weight`.
  void add(const ScreenTriangle& triangle, int weight = 1) {
    std::vector<RowSpan> rows = {{1, 2, 3}};  // to be overwritten
    cover(triangle, width_, height_, rows);
    int last_y = -1;
    for (const RowSpan& row : rows) {
      ASSERT_GT(row.length, 0);
      ASSERT_GT(row.y, last_y) << "rows come from the top down, one a line";
      ASSERT_LT(row.y, height_);
      ASSERT_GE(row.x, 0);
      ASSERT_LE(row.x + row.length, width_);
      last_y = row.y;
      for (int x = row.x; x < row.x + row.length; ++x) counts_[at(x, row.y)] += weight;
    }
  }
  // That each pixel was covered `expected(x, y)` times.
  template <typename Expected>
  void expect(Expected expected) const {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        ASSERT_EQ(count(x, y), expected(x, y)) << "pixel " << x << ", " << y;
      }
    }
  }
  void expect_once_within(const std::vector<Point>& polygon) const {
    expect([&polygon](int x, int y) { return contains(polygon, x, y) ? 1 : 0; });
  }
  int count(int x, int y) const { return counts_[at(x, y)]; }
  int total() const { return std::accumulate(counts_.begin(), counts_.end(), 0); }

 private:
  std::size_t at(int x, int y) const {
    const int place = y * width_ + x;
    return static_cast<std::size_t>(place);
  }
  int width_, height_;
  std::vector<int> counts_;
};

}  // namespace phongpipe
