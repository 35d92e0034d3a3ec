// Coverage is watertight, on 1.3 million random and adversarial triangles: each pixel of a closed
// fan is covered once. Corners may come in any order, whole pixels move, and mirrors mirror the
// rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "testbench/tests/model/fixed/coverage_counting.h"

namespace phongpipe {
namespace {

__extension__ using Wide = __int128;
using Corners = std::array<Point, 3>;

constexpr unsigned kWatertightSeed = 2026;
constexpr int kGrid = kSubpixels >> kGridBits;  // subpixels between snapped coordinates
constexpr int kBlades = 64;                     // of a fan
// Coordinates of vertices around the largest image.
constexpr int kLowest = -kGuardBand * kSubpixels;
constexpr int kHighest = (kMaxImageSize + kGuardBand) * kSubpixels;
// cover() adds up at most four products of coordinates or of their differences.
constexpr Wide kRange = Wide{kHighest} - kLowest;
static_assert(4 * kRange * kRange < std::numeric_limits<std::int64_t>::max());

// Which way a centre on an edge is moved before it is judged: along x, or along y if the edge is
// horizontal. Right and down is the top-left rule.
struct Nudge {
  int x = 1, y = 1;
};

// On which side of the line through two points a third one lies: 1, −1, or 0 on the line.
int side(Point from, Point to, Wide x, Wide y) {
  const Wide turn = (Wide{to.x} - from.x) * (y - from.y) - (Wide{to.y} - from.y) * (x - from.x);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}
int side(Point from, Point to, Point at, Nudge nudge) {
  if (const int off = side(from, to, at.x, at.y)) return off;
  if (const int along_x = side(from, to, Wide{from.x} + nudge.x, from.y)) return along_x;
  return side(from, to, from.x, Wide{from.y} + nudge.y);
}

// The reference: the centre lies on the same side of each edge as the corner that faces the edge.
bool is_inside(const Corners& c, int x, int y, Nudge nudge = {}) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point from = c[i], to = c[(i + 1) % 3], facing = c[(i + 2) % 3];
    const int inner = side(from, to, facing.x, facing.y);
    if (inner == 0 || side(from, to, {centre(x), centre(y)}, nudge) != inner) return false;
  }
  return true;
}

// One of the six orders of the corners.
ScreenTriangle triangle_of(const Corners& c, int order = 0) {
  const auto first = static_cast<std::size_t>(order % 3);
  const std::size_t step = order < 3 ? 1 : 2;
  return triangle_of(c[first], c[(first + step) % 3], c[(first + 2 * step) % 3]);
}
int turn_of(const Corners& c) {
  return side(c[0], c[1], c[2].x, c[2].y);
}

std::vector<RowSpan> rows_of(const ScreenTriangle& triangle, int size) {
  std::vector<RowSpan> rows;
  cover(triangle, size, size, rows);
  return rows;
}
int pixels_of(const std::vector<RowSpan>& rows) {
  int pixels = 0;
  for (const RowSpan& row : rows) pixels += row.length;
  return pixels;
}
void expect_same(const std::vector<RowSpan>& rows, const std::vector<RowSpan>& expected) {
  ASSERT_TRUE(std::equal(rows.begin(), rows.end(), expected.begin(), expected.end(),
                         [](const RowSpan& a, const RowSpan& b) {
                           return a.x == b.x && a.y == b.y && a.length == b.length;
                         }));
}

// In each pixel of an image; returns how many pixels are covered.
int expect_reference(const Corners& corners, int size) {
  CoverageCounter counter(size, size);
  counter.add(triangle_of(corners));
  counter.expect([&corners](int x, int y) { return is_inside(corners, x, y) ? 1 : 0; });
  return counter.total();
}

// A hub and the corners around it. Where a blade is folded over, what it covers counts as −1.
struct Fan {
  Point hub;
  std::vector<Point> rim;
  int folded = 0, flat = 0;

  void expect_watertight(int size) {
    CoverageCounter counter(size, size);
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const Corners blade = {hub, rim[k], rim[(k + 1) % rim.size()]};
      const int turn = turn_of(blade);
      folded += turn < 0 ? 1 : 0;
      flat += turn == 0 ? 1 : 0;
      counter.add(triangle_of(blade, static_cast<int>(k % 6)), turn == 0 ? 1 : turn);
    }
    counter.expect([this](int x, int y) { return windings(rim, x, y); });
  }
};

double spread(int blade) {
  return blade * 6.283185307179586 / kBlades;
}
Point around(double x, double y, double radius, double angle) {  // pixels
  return {snap(x + radius * std::cos(angle)), snap(y + radius * std::sin(angle))};
}

TEST(Watertight, FansOf64MeetOnAPixelCentre) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  for (int i = 0; i < 4000; ++i) {
    const int x = random.integer(4, 19), y = random.integer(4, 19);
    Fan fan = {{centre(x), centre(y)}, {}};
    for (int k = 0; k < kBlades; ++k) {
      fan.rim.push_back(around(x + 0.5, y + 0.5, random.uniform(1, 14), spread(k)));
    }
    fan.expect_watertight(24);
    EXPECT_EQ(windings(fan.rim, x, y), 1) << "the hub is a pixel";
    ASSERT_FALSE(HasFailure()) << "fan " << i;
    ASSERT_EQ(fan.folded + fan.flat, 0);
  }
}

// The k-th of 64 points on the border of a square from −8 to 8.
Point on_square(int k) {
  const int along = k % 16;
  const std::array<Point, 4> sides = {
      Point{along - 8, -8}, {8, along - 8}, {8 - along, 8}, {-8, 8 - along}};
  return sides[static_cast<std::size_t>(k / 16)];
}

// All blades run along centres, or along the edges between pixels.
TEST(Watertight, FansOf64HaveSpokesOverPixelCentres) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  for (int i = 0; i < 4000; ++i) {
    const Point hub = {centre(random.integer(4, 19)), centre(random.integer(4, 19))};
    Fan fan = {hub, {}};
    for (int k = 0; k < kBlades; ++k) {
      const Point direction = on_square(k);
      const int length = random.integer(1, 3) * kSubpixels / 2;
      fan.rim.push_back({hub.x + length * direction.x, hub.y + length * direction.y});
    }
    fan.expect_watertight(24);
    ASSERT_FALSE(HasFailure()) << "fan " << i;
    ASSERT_EQ(fan.folded + fan.flat, 0);
  }
}

// So small that snapping makes lines of blades, and turns others over.
TEST(Watertight, FansThatSnappingFoldsOver) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr double kStep = 1.0 / (1 << kGridBits);
  int folded = 0, flat = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = 1.5 + random.integer(-1, 1) * kStep, y = 1.5 + random.integer(-1, 1) * kStep;
    Fan fan = {{snap(x), snap(y)}, {}};
    const double radius = random.uniform(1, 8) * kStep;
    for (int k = 0; k < kBlades; ++k) {
      fan.rim.push_back(around(x, y, radius * random.uniform(0.3, 1), spread(k)));
    }
    fan.expect_watertight(3);
    ASSERT_FALSE(HasFailure()) << "fan " << i;
    folded += fan.folded;
    flat += fan.flat;
  }
  EXPECT_GT(folded, 10000);
  EXPECT_GT(flat, 50000);
}

TEST(Watertight, FansAroundAnyTangle) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  for (int i = 0; i < 2000; ++i) {
    Fan fan = {random_point(random, -4, 20), {}};
    for (int k = 0; k < kBlades; ++k) fan.rim.push_back(random_point(random, -4, 20));
    fan.expect_watertight(16);
    ASSERT_FALSE(HasFailure()) << "fan " << i;
  }
}

// One in eight is a line or a point, one in four is about as small as a pixel.
Corners random_corners(Random& random, int low, int high) {
  const Point p = random_point(random, low, high), q = random_point(random, low, high);
  const Point small = random_point(random, -1, 1), r = random_point(random, low, high);
  switch (random.integer(0, 7)) {
    case 0:
      return {p, q, {p.x + 2 * (q.x - p.x), p.y + 2 * (q.y - p.y)}};
    case 1:
    case 2:
      return {p, {p.x + small.x, p.y + small.y}, {p.x + small.y, p.y + small.x}};
    default:
      return {p, q, r};
  }
}

TEST(Watertight, EveryOrderOfTheCornersIsTheReference) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kSize = 12;
  int covered = 0;
  for (int i = 0; i < 60000; ++i) {
    const Corners corners = random_corners(random, -4, 16);
    covered += expect_reference(corners, kSize);
    const std::vector<RowSpan> rows = rows_of(triangle_of(corners), kSize);
    for (int order = 1; order < 6; ++order) {
      expect_same(rows_of(triangle_of(corners, order), kSize), rows);
    }
    ASSERT_FALSE(HasFailure()) << "triangle " << i;
  }
  EXPECT_GT(covered, 500000);
}

// Moved by whole pixels, and cut off at an image's borders.
std::vector<RowSpan> moved(const std::vector<RowSpan>& rows, int dx, int dy, int size) {
  std::vector<RowSpan> result;
  for (const RowSpan& row : rows) {
    const int from = std::max(0, row.x + dx), to = std::min(size, row.x + dx + row.length);
    const int y = row.y + dy;
    if (y >= 0 && y < size && from < to) result.push_back({from, y, to - from});
  }
  return result;
}

TEST(Watertight, MovingByWholePixelsMovesTheRows) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kReach = 16;  // of a triangle
  int cut = 0;
  for (int i = 0; i < 100000; ++i) {
    const Corners corners = random_corners(random, 4, 12);
    const int size = random.integer(0, 1) == 0 ? 24 : kMaxImageSize;
    const int dx = random.integer(-kReach, size), dy = random.integer(-kReach, size);
    Corners elsewhere = corners;
    for (Point& p : elsewhere) p = {p.x + dx * kSubpixels, p.y + dy * kSubpixels};
    const std::vector<RowSpan> rows = rows_of(triangle_of(corners), 24);
    const std::vector<RowSpan> expected = moved(rows, dx, dy, size);
    expect_same(rows_of(triangle_of(elsewhere), size), expected);
    ASSERT_FALSE(HasFailure()) << "triangle " << i;
    cut += pixels_of(expected) < pixels_of(rows) ? 1 : 0;
  }
  EXPECT_GT(cut, 10000);
  EXPECT_LT(cut, 50000);
}

// At the image's vertical middle, its horizontal one, or both.
struct Mirror {
  bool x, y;
};
constexpr std::array<Mirror, 3> kMirrors = {Mirror{true, false}, {false, true}, {true, true}};

Corners mirrored(Corners corners, Mirror mirror, int size) {
  for (Point& p : corners) {
    if (mirror.x) p.x = size * kSubpixels - p.x;
    if (mirror.y) p.y = size * kSubpixels - p.y;
  }
  return corners;
}
std::vector<RowSpan> mirrored(std::vector<RowSpan> rows, Mirror mirror, int size) {
  for (RowSpan& row : rows) {
    if (mirror.x) row.x = size - row.x - row.length;
    if (mirror.y) row.y = size - 1 - row.y;
  }
  if (mirror.y) std::reverse(rows.begin(), rows.end());
  return rows;
}

// In steps of the grid, centres are even. The corners are odd in y, in x, and in both, so that the
// edge function of two of them is odd wherever both coordinates are even.
Corners corners_off_centres(Random& random) {
  constexpr int kHalfPixel = kSubpixels / kGrid / 2;  // in steps
  const auto coordinate = [&random](int odd) {
    return (2 * random.integer(-4 * kHalfPixel, 20 * kHalfPixel) + odd) * kGrid;
  };
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i].x = coordinate(i > 0 ? 1 : 0);
    corners[i].y = coordinate(i < 2 ? 1 : 0);
  }
  return corners;
}

TEST(Watertight, MirroringMirrorsTheRowsWhereNoCentreIsOnAnEdge) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kSize = 16;
  for (int i = 0; i < 60000; ++i) {
    const Corners corners = corners_off_centres(random);
    const std::vector<RowSpan> rows = rows_of(triangle_of(corners), kSize);
    for (const Mirror mirror : kMirrors) {
      expect_same(rows_of(triangle_of(mirrored(corners, mirror, kSize)), kSize),
                  mirrored(rows, mirror, kSize));
    }
    ASSERT_FALSE(HasFailure()) << "triangle " << i;
  }
}

TEST(Watertight, MirroringMirrorsTheRuleForCentresOnEdges) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kSize = 12;
  int decided = 0;  // by the rule
  for (int i = 0; i < 20000; ++i) {
    const Corners corners = random_corners(random, -4, 16);
    for (const Mirror mirror : kMirrors) {
      const Nudge nudge = {mirror.x ? -1 : 1, mirror.y ? -1 : 1};
      CoverageCounter counter(kSize, kSize);
      counter.add(triangle_of(mirrored(corners, mirror, kSize)));
      counter.expect([&](int x, int y) {
        const int from_x = mirror.x ? kSize - 1 - x : x, from_y = mirror.y ? kSize - 1 - y : y;
        const bool inside = is_inside(corners, from_x, from_y, nudge);
        decided += inside != is_inside(corners, from_x, from_y) ? 1 : 0;
        return inside ? 1 : 0;
      });
    }
    ASSERT_FALSE(HasFailure()) << "triangle " << i;
  }
  EXPECT_GT(decided, 5000);
}

// Up to 16,384 pixels long, and less than one wide where they cross the image.
TEST(Watertight, NeedlesAreTheReference) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kSize = 16;
  int covered = 0;
  for (int i = 0; i < 40000; ++i) {
    const int reach = random.integer(0, 1) == 0 ? 40 : kGuardBand - 1;
    const Point middle = random_point(random, 0, kSize), half = random_point(random, -reach, reach);
    const Point width = random_point(random, -1, 1);
    const Point tip = {middle.x - half.x, middle.y - half.y};
    const Point end = {middle.x + half.x, middle.y + half.y};
    const Corners needle = {tip, end, {end.x + width.x, end.y + width.y}};
    covered += expect_reference(needle, kSize);
    ASSERT_FALSE(HasFailure()) << "needle " << i;
  }
  EXPECT_GT(covered, 100000);
}

// Needles side by side from a far tip to a straight base in the image: together they are one
// triangle, and cover what it covers.
TEST(Watertight, ABundleOf64NeedlesIsItsHull) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kSize = 16;
  int covered = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point tip = random_point(random, -kGuardBand, kSize + kGuardBand);
    const Point base = random_point(random, 0, kSize);
    const Point step = {random.integer(-64, 64), random.integer(-64, 64)};
    const auto on_base = [&](int k) { return Point{base.x + k * step.x, base.y + k * step.y}; };
    CoverageCounter counter(kSize, kSize);
    for (int k = 0; k < kBlades; ++k) {
      counter.add(triangle_of({tip, on_base(k), on_base(k + 1)}, k % 6));
    }
    const Corners hull = {tip, base, on_base(kBlades)};
    counter.expect([&](int x, int y) { return is_inside(hull, x, y) ? 1 : 0; });
    ASSERT_FALSE(HasFailure()) << "bundle " << i;
    covered += counter.total();
  }
  EXPECT_GT(covered, 10000);
}

// A parallelogram that is one pixel wide and as high as the largest image. Whatever its slant, it
// holds one centre in each row.
struct Strip {
  std::vector<Point> corners;

  Strip(Random& random, bool upright) {
    const auto along = [&random] { return random_point(random, 0, kMaxImageSize - 1).x; };
    const int from = along(), to = random.integer(0, 3) == 0 ? from : along();
    const int end = kMaxImageSize * kSubpixels;
    corners = {{from, 0}, {from + kSubpixels, 0}, {to + kSubpixels, end}, {to, end}};
    for (Point& p : corners) {
      if (!upright) std::swap(p.x, p.y);
    }
  }
  std::array<Corners, 2> halves() const {
    const auto& c = corners;
    return {Corners{c[0], c[1], c[2]}, {c[2], c[3], c[0]}};
  }
};

TEST(Watertight, AnUprightStripIsOnePixelInEachOf4096Rows) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  for (int i = 0; i < 300; ++i) {
    const Strip strip(random, true);
    std::vector<int> pixels(kMaxImageSize);
    for (const Corners& half : strip.halves()) {
      for (const RowSpan& row : rows_of(triangle_of(half), kMaxImageSize)) {
        ASSERT_EQ(row.length, 1);
        ASSERT_TRUE(is_inside(half, row.x, row.y)) << row.x << ", " << row.y;
        ++pixels[static_cast<std::size_t>(row.y)];
      }
    }
    ASSERT_EQ(pixels, std::vector<int>(kMaxImageSize, 1)) << "strip " << i;
  }
}

TEST(Watertight, ALyingStripIsOnePixelInEachOf4096Columns) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  for (int i = 0; i < 300; ++i) {
    const Strip strip(random, false);
    std::vector<int> pixels(kMaxImageSize);
    for (const Corners& half : strip.halves()) {
      for (const RowSpan& row : rows_of(triangle_of(half), kMaxImageSize)) {
        for (int x = row.x; x < row.x + row.length; ++x) {
          ASSERT_TRUE(is_inside(half, x, row.y)) << x << ", " << row.y;
          ++pixels[static_cast<std::size_t>(x)];
        }
      }
    }
    ASSERT_EQ(pixels, std::vector<int>(kMaxImageSize, 1)) << "strip " << i;
  }
}

// Within two pixels of one end or the other of what a coordinate can be.
Point far_corner(Random& random) {
  const Point off = random_point(random, 0, 2);
  const auto coordinate = [&random](int inwards) {
    return random.integer(0, 1) == 0 ? kLowest + inwards : kHighest - inwards;
  };
  const bool exact = random.integer(0, 1) == 0;
  const int x = coordinate(exact ? 0 : off.x);
  return {x, coordinate(exact ? 0 : off.y)};
}

// Each row whole, against the reference, at the image's ends and between them.
TEST(Watertight, CornersAtTheEndsOfTheirRangeAreTheReference) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kLast = kMaxImageSize - 1;
  int covered = 0;
  for (int i = 0; i < 400; ++i) {
    const bool one_inside = random.integer(0, 1) == 0;
    const Corners corners = {
        far_corner(random), far_corner(random),
        one_inside ? random_point(random, 0, kMaxImageSize) : far_corner(random)};
    std::vector<RowSpan> by_line(kMaxImageSize);
    for (const RowSpan& row : rows_of(triangle_of(corners, i % 6), kMaxImageSize)) {
      by_line[static_cast<std::size_t>(row.y)] = row;
    }
    for (const int y : {0, random.integer(1, kLast), random.integer(1, kLast), kLast}) {
      const RowSpan& row = by_line[static_cast<std::size_t>(y)];
      for (int x = 0; x <= kLast; ++x) {
        ASSERT_EQ(x >= row.x && x < row.x + row.length, is_inside(corners, x, y))
            << "triangle " << i << ", pixel " << x << ", " << y;
      }
      covered += row.length;
    }
  }
  EXPECT_GT(covered, 500000);
}

// That the spans, in any order, lie end to end from the first pixel of their row to its last.
void expect_filled(std::vector<RowSpan>& row) {
  std::sort(row.begin(), row.end(), [](const RowSpan& a, const RowSpan& b) { return a.x < b.x; });
  int end = 0;
  for (const RowSpan& span : row) {
    ASSERT_EQ(span.x, end) << "row " << span.y;
    end += span.length;
  }
  ASSERT_EQ(end, kMaxImageSize);
}

// The rim is the border of all that coordinates can be, with its corners.
TEST(Watertight, FansOf64ToTheEndsOfTheRangeFillTheImage) {
  SCOPED_TRACE(kWatertightSeed);
  Random random(kWatertightSeed);
  constexpr int kUnit = (kHighest - kLowest) / 16;  // on_square() is 16 wide
  for (int i = 0; i < 10; ++i) {
    const Point hub = {centre(random.integer(0, kMaxImageSize - 1)),
                       centre(random.integer(0, kMaxImageSize - 1))};
    const auto rim = [](int k) {
      const Point p = on_square(k % kBlades);
      return Point{kLowest + (p.x + 8) * kUnit, kLowest + (p.y + 8) * kUnit};
    };
    std::vector<std::vector<RowSpan>> rows(kMaxImageSize);
    for (int k = 0; k < kBlades; ++k) {
      const ScreenTriangle blade = triangle_of({hub, rim(k), rim(k + 1)}, k % 6);
      for (const RowSpan& row : rows_of(blade, kMaxImageSize)) {
        rows[static_cast<std::size_t>(row.y)].push_back(row);
      }
    }
    for (std::vector<RowSpan>& row : rows) expect_filled(row);
    ASSERT_FALSE(HasFailure()) << "fan " << i;
  }
}

}  // namespace
}  // namespace phongpipe
