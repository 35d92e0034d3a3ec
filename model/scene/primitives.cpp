#include "model/scene/primitives.h"

#include <algorithm>
#include <cmath>

#include "model/scene/teapot.h"

namespace phongpipe {
namespace {

constexpr double kTau = 6.283185307179586;

// A point of a curve that is revolved about the y axis. (normal_r, normal_y) is unit and points
// outwards. A radius of exactly zero is a pole.
struct ProfilePoint {
  double radius;
  double y;
  double normal_r;
  double normal_y;
};

std::size_t product(Segments segments) {
  return static_cast<std::size_t>(segments[0]) * static_cast<std::size_t>(segments[1]);
}

// The profile is given from the top downwards, seen with the outside to its right; `closed` joins
// its end to its start. Quads that touch a pole give one triangle.
Mesh revolve(const std::vector<ProfilePoint>& profile, int around, bool closed) {
  Mesh mesh;
  const auto columns = static_cast<std::uint32_t>(around);
  const auto rows = static_cast<std::uint32_t>(profile.size());
  mesh.positions.reserve(profile.size() * columns);
  mesh.normals.reserve(profile.size() * columns);
  for (const ProfilePoint& point : profile) {
    for (int i = 0; i < around; ++i) {
      const double angle = kTau * i / around;
      const Vec3 outwards(std::sin(angle), 0, std::cos(angle));
      mesh.positions.emplace_back(outwards * point.radius + Vec3(0, point.y, 0));
      mesh.normals.emplace_back(
          (outwards * point.normal_r + Vec3(0, point.normal_y, 0)).normalized());
    }
  }
  const std::uint32_t bands = closed ? rows : rows - 1;
  for (std::uint32_t band = 0; band < bands; ++band) {
    const std::uint32_t above = band * columns;
    const std::uint32_t below = (band + 1) % rows * columns;
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t next = (i + 1) % columns;
      if (profile[band].radius != 0) {
        mesh.faces.push_back({{above + i, below + i, above + next}});
      }
      if (profile[(band + 1) % rows].radius != 0) {
        mesh.faces.push_back({{above + next, below + i, below + next}});
      }
    }
  }
  return mesh;
}

Mesh make_sphere(Segments segments) {
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= segments[1]; ++i) {
    const double angle = kTau / 2 * i / segments[1];
    const bool pole = i == 0 || i == segments[1];
    const double r = pole ? 0 : std::sin(angle);
    profile.push_back({r, std::cos(angle), r, std::cos(angle)});
  }
  return revolve(profile, segments[0], false);
}

Mesh make_torus(Segments segments) {
  constexpr double kTube = 0.4;
  std::vector<ProfilePoint> profile;
  for (int i = 0; i < segments[1]; ++i) {
    const double angle = kTau * i / segments[1];
    const double r = std::sin(angle);
    const double y = std::cos(angle);
    profile.push_back({1 + kTube * r, kTube * y, r, y});
  }
  return revolve(profile, segments[0], true);
}

Mesh make_plane(Segments segments) {
  Mesh mesh;
  for (int j = 0; j <= segments[1]; ++j) {
    for (int i = 0; i <= segments[0]; ++i) {
      mesh.positions.emplace_back(2.0 * i / segments[0] - 1, 0, 2.0 * j / segments[1] - 1);
      mesh.normals.emplace_back(Vec3::UnitY());
    }
  }
  const auto columns = static_cast<std::uint32_t>(segments[0]) + 1;
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(segments[1]); ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t corner = j * columns + i;
      mesh.faces.push_back({{corner, corner + columns, corner + 1}});
      mesh.faces.push_back({{corner + 1, corner + columns, corner + columns + 1}});
    }
  }
  return mesh;
}

// The control polygon of the pawn's profile, (radius, y) from the top of the head to the foot. A
// uniform cubic B-spline follows it smoothly, with continuous curvature. The head is close to a
// sphere of radius 0.32: its points lie 30 degrees apart.
constexpr std::array<std::array<double, 2>, 21> kPawnProfile = {{
    {1e-4, 2.015}, {0.1675, 1.970}, {0.290, 1.8475}, {0.335, 1.68}, {0.290, 1.5125}, {0.20, 1.44},
    {0.20, 1.41},  {0.37, 1.40},    {0.40, 1.355},   {0.37, 1.31},  {0.24, 1.285},   {0.20, 1.16},
    {0.215, 0.95}, {0.26, 0.72},    {0.34, 0.52},    {0.49, 0.40},  {0.52, 0.31},    {0.54, 0.25},
    {0.68, 0.19},  {0.72, 0.09},    {0.72, 0.00},
}};

ProfilePoint pawn_profile(double t) {
  constexpr auto kSpans = static_cast<int>(kPawnProfile.size()) - 1;
  const int span = std::min(static_cast<int>(t * kSpans), kSpans - 1);
  const double u = t * kSpans - span;
  // Beyond the top the profile goes on as its own mirror image, so that the head is round there;
  // beyond the foot as its reflection in the last point, so that it ends in that point.
  const auto control = [](int index) -> std::array<double, 2> {
    const auto at = [](int i) { return kPawnProfile[static_cast<std::size_t>(i)]; };
    if (index < 0) {
      return {2 * at(0)[0] - at(1)[0], at(1)[1]};
    }
    if (index > kSpans) {
      return {2 * at(kSpans)[0] - at(kSpans - 1)[0], 2 * at(kSpans)[1] - at(kSpans - 1)[1]};
    }
    return at(index);
  };
  std::array<double, 2> point{};
  std::array<double, 2> tangent{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double a = control(span - 1)[axis];
    const double b = control(span)[axis];
    const double c = control(span + 1)[axis];
    const double d = control(span + 2)[axis];
    point[axis] = (a * (1 - u) * (1 - u) * (1 - u) + b * (3 * u * u * u - 6 * u * u + 4) +
                   c * (-3 * u * u * u + 3 * u * u + 3 * u + 1) + d * u * u * u) /
                  6;
    tangent[axis] = (-a * (1 - u) * (1 - u) + b * (3 * u * u - 4 * u) +
                     c * (-3 * u * u + 2 * u + 1) + d * u * u) /
                    2;
  }
  const double length = std::hypot(tangent[0], tangent[1]);
  return {point[0], point[1], -tangent[1] / length, tangent[0] / length};
}

// Parameters that cut the profile into pieces of equal bend and length: rings stand close where the
// profile turns, so that no triangle spans a large angle of normals.
std::vector<double> pawn_rings(int along) {
  constexpr int kSamples = 4096;
  constexpr double kBendWeight = 1;  // a radian counts as much as so many units of length
  std::vector<double> measure = {0};
  ProfilePoint last = pawn_profile(0);
  for (int i = 1; i <= kSamples; ++i) {
    const ProfilePoint next = pawn_profile(static_cast<double>(i) / kSamples);
    const double sine = last.normal_r * next.normal_y - last.normal_y * next.normal_r;
    const double cosine = last.normal_r * next.normal_r + last.normal_y * next.normal_y;
    measure.push_back(measure.back() + std::hypot(next.radius - last.radius, next.y - last.y) +
                      kBendWeight * std::abs(std::atan2(sine, cosine)));
    last = next;
  }
  std::vector<double> rings;
  for (int i = 0; i <= along; ++i) {
    const double wanted = measure.back() * i / along;
    const auto sample = std::lower_bound(measure.begin(), measure.end(), wanted) - measure.begin();
    rings.push_back(static_cast<double>(sample) / kSamples);
  }
  return rings;
}

Mesh make_pawn(Segments segments) {
  std::vector<ProfilePoint> profile;
  for (const double t : pawn_rings(segments[1])) {
    profile.push_back(pawn_profile(t));
  }
  return revolve(profile, segments[0], false);
}

std::size_t two_per_quad(Segments segments) {
  return 2 * product(segments);
}

std::size_t two_per_quad_but_poles(Segments segments) {
  return 2 * product({segments[0], segments[1] - 1});
}

}  // namespace

const std::vector<Primitive>& primitives() {
  static const std::vector<Primitive> all = {
      {"teapot", {10, 10}, {2, 2}, teapot_triangles, make_teapot},
      {"sphere", {64, 32}, {3, 2}, two_per_quad_but_poles, make_sphere},
      {"torus", {64, 32}, {3, 3}, two_per_quad, make_torus},
      {"pawn", {170, 43}, {3, 1}, two_per_quad, make_pawn},
      {"plane", {1, 1}, {1, 1}, two_per_quad, make_plane},
  };
  return all;
}

const Primitive* find_primitive(const std::string& name) {
  for (const Primitive& primitive : primitives()) {
    if (name == primitive.name) {
      return &primitive;
    }
  }
  return nullptr;
}

}  // namespace phongpipe
