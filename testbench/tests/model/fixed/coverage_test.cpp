// Coverage: triangles that share an edge cover each pixel once, wherever vertices and edges fall.
#include "model/fixed/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "testbench/tests/model/fixed/coverage_counting.h"

namespace phongpipe {
namespace {

constexpr unsigned kCoverageSeed = 77;

TEST(Coverage, OfOneTriangleIsTheTopLeftRule) {
  SCOPED_TRACE(kCoverageSeed);
  Random random(kCoverageSeed);
  int covered = 0;
  for (int i = 0; i < 4000; ++i) {
    const Point p = random_point(random, -4, 20), q = random_point(random, -4, 20);
    const Point r = random_point(random, -4, 20);
    CoverageCounter counter(16, 12), turned(16, 12);
    counter.add(triangle_of(p, q, r));
    turned.add(triangle_of(r, q, p));
    counter.expect_once_within({p, q, r});
    turned.expect_once_within({p, q, r});
    ASSERT_FALSE(HasFailure()) << "case " << i;
    covered += counter.total();
  }
  EXPECT_GT(covered, 100000);
}

// Drawn by hand: pixel centres at .5.
TEST(Coverage, ASquareOfCentresTakesItsTopAndLeftEdge) {
  const Point a = {centre(2), centre(3)}, b = {centre(6), centre(3)};
  const Point c = {centre(6), centre(8)}, d = {centre(2), centre(8)};
  CoverageCounter counter(16, 16);
  counter.add(triangle_of(a, b, c));
  counter.add(triangle_of(a, c, d));
  counter.expect([](int x, int y) { return x >= 2 && x < 6 && y >= 3 && y < 8 ? 1 : 0; });
}

TEST(Coverage, AFanCoversEachPixelOnce) {
  SCOPED_TRACE(kCoverageSeed);
  Random random(kCoverageSeed);
  for (int i = 0; i < 300; ++i) {
    const Point hub = random_point(random, 8, 24);
    const int blades = random.integer(4, 9);  // each less than half a turn
    std::vector<Point> rim;
    for (int k = 0; k < blades; ++k) {
      const double angle = (k + random.uniform(-0.4, 0.4)) * 6.283185307179586 / blades;
      const double radius = random.uniform(3, 30);
      rim.push_back(
          {hub.x + snap(radius * std::cos(angle)), hub.y + snap(radius * std::sin(angle))});
    }
    CoverageCounter counter(32, 32);
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Point& next = rim[(k + 1) % rim.size()];
      counter.add(k % 2 == 0 ? triangle_of(hub, rim[k], next) : triangle_of(next, rim[k], hub));
    }
    counter.expect_once_within(rim);
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

TEST(Coverage, AGridCoversTheImageOnce) {
  SCOPED_TRACE(kCoverageSeed);
  Random random(kCoverageSeed);
  constexpr int kCells = 8, kCell = 6, kSize = 40;  // reaches 4 pixels beyond the image all round
  for (int i = 0; i < 100; ++i) {
    std::array<std::array<Point, kCells + 1>, kCells + 1> corner;
    for (int row = 0; row <= kCells; ++row) {
      for (int column = 0; column <= kCells; ++column) {
        const Point jitter = random_point(random, -1, 1);
        corner[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = {
            (column * kCell - 4) * kSubpixels + jitter.x,
            (row * kCell - 4) * kSubpixels + jitter.y};
      }
    }
    CoverageCounter counter(kSize, kSize);
    for (std::size_t row = 0; row < kCells; ++row) {
      for (std::size_t column = 0; column < kCells; ++column) {
        const Point a = corner[row][column], b = corner[row][column + 1];
        const Point c = corner[row + 1][column + 1], d = corner[row + 1][column];
        counter.add(triangle_of(a, b, c));
        counter.add(triangle_of(d, c, a));
      }
    }
    counter.expect([](int, int) { return 1; });
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

TEST(Coverage, ATriangleWithoutAreaCoversNothing) {
  std::vector<RowSpan> rows = {{0, 0, 1}};
  cover(triangle_of({0, 0}, {5 * kSubpixels, 5 * kSubpixels}, {9 * kSubpixels, 9 * kSubpixels}), 16,
        16, rows);
  EXPECT_TRUE(rows.empty());
}

// Corners as far out as the guard band lets them be: no product may overflow.
TEST(Coverage, HoldsUpToTheGuardBand) {
  SCOPED_TRACE(kCoverageSeed);
  Random random(kCoverageSeed);
  const int size = kMaxImageSize, low = -kGuardBand, high = kMaxImageSize + kGuardBand;
  for (int i = 0; i < 200; ++i) {
    const auto corner = [&] {
      const int x = random.integer(0, 1) == 0 ? low : high;
      const int y = random.integer(0, 1) == 0 ? low : high;
      const Point p = random_point(random, 0, 40);
      return Point{x * kSubpixels + (x < 0 ? p.x : -p.x), y * kSubpixels + (y < 0 ? p.y : -p.y)};
    };
    const std::vector<Point> polygon = {corner(), corner(), random_point(random, low, high)};
    std::vector<RowSpan> rows;
    cover(triangle_of(polygon[0], polygon[1], polygon[2]), size, size, rows);
    std::vector<RowSpan> by_line(static_cast<std::size_t>(size));
    for (const RowSpan& row : rows) by_line[static_cast<std::size_t>(row.y)] = row;
    for (int k = 0; k < 200; ++k) {
      const int y = random.integer(0, size - 1);
      const RowSpan row = by_line[static_cast<std::size_t>(y)];
      for (const int x :
           {0, row.x - 1, row.x, row.x + row.length - 1, row.x + row.length, size - 1}) {
        if (x < 0 || x >= size) continue;
        ASSERT_EQ(row.x <= x && x < row.x + row.length, contains(polygon, x, y))
            << "triangle " << i << ", pixel " << x << ", " << y;
      }
    }
  }
}

TEST(ExpansionPixel, IsTheCoveredPixelNearestToTheCentroid) {
  SCOPED_TRACE(kCoverageSeed);
  Random random(kCoverageSeed);
  int outside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point p = random_point(random, -20, 40), q = random_point(random, -20, 40);
    const Point r = random_point(random, -20, 40);
    const ScreenTriangle triangle = triangle_of(p, q, r);
    std::vector<RowSpan> rows;
    cover(triangle, 24, 24, rows);
    if (rows.empty()) continue;
    const auto distance = [&](int x, int y) {  // squared, times 9
      const std::int64_t dx = 3 * (x * kSubpixels + kSubpixels / 2) - (p.x + q.x + r.x);
      const std::int64_t dy = 3 * (y * kSubpixels + kSubpixels / 2) - (p.y + q.y + r.y);
      return dx * dx + dy * dy;
    };
    std::int64_t nearest = distance(rows.front().x, rows.front().y);
    const Pixel chosen = expansion_pixel(triangle, rows);
    bool covered = false;
    for (const RowSpan& row : rows) {
      for (int x = row.x; x < row.x + row.length; ++x) {
        nearest = std::min(nearest, distance(x, row.y));
        covered = covered || (x == chosen.x && row.y == chosen.y);
      }
    }
    ASSERT_TRUE(covered) << "case " << i;
    ASSERT_EQ(distance(chosen.x, chosen.y), nearest) << "case " << i;
    if (nearest > 9 * kSubpixels * kSubpixels) ++outside;
  }
  EXPECT_GT(outside, 50) << "too few centroids lie outside the image";
}

}  // namespace
}  // namespace phongpipe
