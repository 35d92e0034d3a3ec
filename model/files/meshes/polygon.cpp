#include "model/files/meshes/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace phongpipe {
namespace {

using Vec2 = Eigen::Vector2d;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A polygon that touches itself so that no ear is found is cut in two where it does, and the parts
// again. Which of the places is right is tried, so often.
constexpr int kMaxAttempts = 64;

// Twice the area of a triangle, positive if it goes counter-clockwise.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a, ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

// Along the polygon's mean normal (Newell), twice its area long.
Vec3 area_vector(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  }
  return sum;
}

// The points seen against the normal, along the axis that is nearest to it. Counter-clockwise.
std::vector<Vec2> along_axis(const std::vector<Vec3>& corners, const Vec3& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Vec2> points;
  points.reserve(corners.size());
  for (const Vec3& corner : corners) {
    points.emplace_back(corner[u] - corners[0][u], corner[v] - corners[0][v]);
  }
  return points;
}

// The same along the normal itself, which rounds the points.
std::vector<Vec2> along_normal(const std::vector<Vec3>& corners, const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal(), v = normal.normalized().cross(u);
  std::vector<Vec2> points;
  points.reserve(corners.size());
  for (const Vec3& corner : corners) {
    points.emplace_back(u.dot(corner - corners[0]), v.dot(corner - corners[0]));
  }
  return points;
}

Triangles fan(std::size_t corners) {
  Triangles triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

// Clips corner after corner from a polygon of positive area. All triangles have positive area, or
// one that is nearly zero; so they cover each point as often as the outline goes around it: a
// polygon that does not cross itself is covered once, whichever ears were clipped.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Vec2> points)
      : points_(std::move(points)),
        previous_(points_.size()),
        next_(points_.size()),
        area_(points_.size()) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    double extent = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      previous_[i] = (i + count - 1) % count;
      next_[i] = (i + 1) % count;
      extent = std::max(extent, points_[i].cwiseAbs().maxCoeff());
    }
    nearly_zero_ = 1e-12 * extent * extent;
    for (std::uint32_t i = 0; i < count; ++i) measure(i);
  }

  // A star turns left at every corner, too, but goes around more than once.
  bool convex() const {
    int turns = 0;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const Vec2 before = points_[i] - points_[previous_[i]],
                 after = points_[next_[i]] - points_[i];
      if (area_[i] <= 0) return false;
      turns += before.y() <= 0 && after.y() > 0 ? 1 : 0;
    }
    return turns == 1;
  }

  bool crosses_itself() const {
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const Vec2 &a = points_[i], &b = points_[next_[i]];
      for (std::uint32_t j = i + 2; j < points_.size(); ++j) {
        const Vec2 &c = points_[j], &d = points_[next_[j]];
        if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) ||
            std::max(c.x(), d.x()) < std::min(a.x(), b.x())) {
          continue;
        }
        if (opposite(area(a, b, c), area(a, b, d)) && opposite(area(c, d, a), area(c, d, b))) {
          return true;
        }
      }
    }
    return false;
  }

  std::optional<Triangles> run() {
    Triangles triangles;
    std::size_t left = points_.size();
    std::uint32_t corner = 0;
    std::size_t refused = 0;
    Strictness strictness = Strictness::nothing_on_border;
    while (left > 3) {
      if (!is_ear(corner, strictness)) {
        corner = next_[corner];
        if (++refused < left) continue;
        if (strictness == Strictness::flat) return std::nullopt;
        strictness = static_cast<Strictness>(static_cast<int>(strictness) + 1);
        refused = 0;
        continue;
      }
      triangles.push_back({previous_[corner], corner, next_[corner]});
      const std::uint32_t before = previous_[corner], after = next_[corner];
      next_[before] = after;
      previous_[after] = before;
      measure(before);
      measure(after);
      --left;
      corner = next_[after];  // clipping neighbours in turn would make slivers
      refused = 0;
      strictness = Strictness::nothing_on_border;
    }
    if (area_[corner] < -nearly_zero_) return std::nullopt;
    triangles.push_back({previous_[corner], corner, next_[corner]});
    return triangles;
  }

 private:
  // What an ear may be, each in turn where there is no other: one without other corners on its
  // border, with such, and one without area.
  enum class Strictness { nothing_on_border, nothing_inside, flat };

  static bool opposite(double a, double b) { return (a > 0 && b < 0) || (a < 0 && b > 0); }

  void measure(std::uint32_t corner) {
    area_[corner] = area(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
  }

  bool is_ear(std::uint32_t corner, Strictness strictness) const {
    if (strictness == Strictness::flat) return std::abs(area_[corner]) <= nearly_zero_;
    if (area_[corner] <= 0) return false;
    const Vec2 &a = points_[previous_[corner]], &b = points_[corner], &c = points_[next_[corner]];
    const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (std::uint32_t i = next_[next_[corner]]; i != previous_[corner]; i = next_[i]) {
      const Vec2& p = points_[i];
      if (area_[i] > 0) continue;  // no other corner is inside without a reflex one
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;
      if (p == a || p == b || p == c) continue;  // where a cut to a hole goes there and back
      const double least = std::min({area(a, b, p), area(b, c, p), area(c, a, p)});
      if (strictness == Strictness::nothing_on_border ? least >= 0 : least > 0) return false;
    }
    return true;
  }

  std::vector<Vec2> points_;
  std::vector<std::uint32_t> previous_, next_;  // of the corners that are left
  std::vector<double> area_;                    // of the triangle of a corner and its neighbours
  double nearly_zero_ = 0;
};

// Whether all corners are on one line, as nearly as rounding tells.
bool is_flat(const std::vector<Vec3>& corners) {
  Vec3 longest = Vec3::Zero();
  for (const Vec3& corner : corners) {
    const Vec3 side = corner - corners[0];
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
    return (corner - corners[0]).cross(longest).norm() <= 1e-12 * longest.squaredNorm();
  });
}

}  // namespace

namespace {

// `attempts`: how often a polygon that touches itself may still be cut in two to try.
std::optional<Triangles> cut(const std::vector<Vec2>& points, int& attempts);

// Cuts a polygon that meets itself at a corner into two, which go around in the same sense.
std::optional<Triangles> cut_where_it_touches(const std::vector<Vec2>& points, int& attempts) {
  const auto count = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      if (points[i] != points[j]) continue;
      if (--attempts < 0) return std::nullopt;
      std::optional<Triangles> whole = Triangles();
      for (const bool inner : {true, false}) {
        std::vector<std::uint32_t> part;
        for (std::uint32_t k = 0; k < count; ++k) {
          if ((k >= i && k < j) == inner) part.push_back(k);
        }
        std::vector<Vec2> part_points;
        part_points.reserve(part.size());
        for (const std::uint32_t k : part) part_points.push_back(points[k]);
        const auto triangles = cut(part_points, attempts);
        if (!triangles) {
          whole.reset();
          break;
        }
        for (const auto& [a, b, c] : *triangles) whole->push_back({part[a], part[b], part[c]});
      }
      if (whole) return whole;
    }
  }
  return std::nullopt;
}

std::optional<Triangles> cut(const std::vector<Vec2>& points, int& attempts) {
  if (points.size() < 3) return Triangles();  // a spike
  const EarClipper clipper(points);
  if (clipper.convex()) return fan(points.size());
  if (clipper.crosses_itself()) return std::nullopt;
  if (auto triangles = EarClipper(points).run()) return triangles;
  return cut_where_it_touches(points, attempts);
}

}  // namespace

std::optional<Triangles> cut_polygon(const std::vector<Vec3>& corners) {
  if (is_flat(corners)) return fan(corners.size());
  const Vec3 normal = area_vector(corners);
  if (normal.isZero(0)) return std::nullopt;
  for (const auto& points : {along_axis(corners, normal), along_normal(corners, normal)}) {
    int attempts = kMaxAttempts;
    if (auto triangles = cut(points, attempts)) return triangles;
  }
  return std::nullopt;
}

}  // namespace phongpipe
