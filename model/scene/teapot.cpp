// The control points are those of the 28 patches Martin Newell published in 1975, as Philip
// Schneider's copy of 1990 has them (teasetorig.gz, quoted in freeglut's src/fg_teapot_data.h), in
// the units of Blinn's squashed teapot, plus Frank Crow's bottom of 1987 (as in Eric Haines's SPD
// teapot.c). The data is symmetric: the pot, the lid and the bottom are quarters turned about the y
// axis, spout and handle are halves mirrored in z, so each point is listed once.
#include "model/scene/teapot.h"

#include <Eigen/Geometry>
#include <utility>

namespace phongpipe {
namespace {

using Patch = std::array<std::array<Vec3, 4>, 4>;  // [along][across]; normal = d/dalong × d/dacross

// A row of a quarter: the control points (r, 0), (r, h), (h, r), (0, r) in the plane at height y,
// with h = 0.56 r to within the published digits.
struct Ring {
  double r, h, y;
};
constexpr std::array<std::array<Ring, 4>, 6> kQuarters = {{
    {{{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}}},
    {{{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}}},
    {{{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}}},
    {{{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}}},
    {{{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}}},
    {{{1.5, 0.84, 0.15}, {1.5, 0.84, 0.075}, {1.425, 0.798, 0}, {0, 0, 0}}},
}};

// A row of a half: the control points (xa, ya, 0), (xa, ya, -w), (xb, yb, -w), (xb, yb, 0).
struct Rib {
  double xa, ya, xb, yb, w;
};
constexpr std::array<std::array<Rib, 4>, 4> kHalves = {{
    {{{-1.6, 2.025, -1.5, 2.25, 0.3},
      {-2.3, 2.025, -2.5, 2.25, 0.3},
      {-2.7, 2.025, -3, 2.25, 0.3},
      {-2.7, 1.8, -3, 1.8, 0.3}}},
    {{{-2.7, 1.8, -3, 1.8, 0.3},
      {-2.7, 1.575, -3, 1.35, 0.3},
      {-2.5, 1.125, -2.65, 0.9375, 0.3},
      {-2, 0.9, -1.9, 0.6, 0.3}}},
    {{{1.7, 1.425, 1.7, 0.6, 0.66},
      {2.6, 1.425, 3.1, 0.825, 0.66},
      {2.3, 2.1, 2.4, 2.025, 0.25},
      {2.7, 2.4, 3.3, 2.4, 0.25}}},
    {{{2.7, 2.4, 3.3, 2.4, 0.25},
      {2.8, 2.475, 3.525, 2.49375, 0.25},
      {2.9, 2.475, 3.45, 2.5125, 0.15},
      {2.8, 2.4, 3.2, 2.4, 0.15}}},
}};

constexpr std::size_t kPatches = 4 * kQuarters.size() + 2 * kHalves.size();
constexpr std::size_t kPolePatches = 8;  // the top of the knob and the bottom

std::array<Patch, kPatches> teapot_patches() {
  std::array<Patch, kPatches> patches;
  std::size_t count = 0;
  for (const auto& rings : kQuarters) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      Patch& patch = patches[count++];
      for (std::size_t row = 0; row < 4; ++row) {
        const auto [r, h, y] = rings[row];
        patch[row] = {Vec3(r, y, 0), Vec3(r, y, -h), Vec3(h, y, -r), Vec3(0, y, -r)};
        for (int turn = 0; turn < quarter; ++turn) {
          for (Vec3& point : patch[row]) {
            point = Vec3(point.z(), point.y(), -point.x());
          }
        }
      }
    }
  }
  for (const auto& ribs : kHalves) {
    for (const double side : {1.0, -1.0}) {
      Patch& patch = patches[count++];
      for (std::size_t row = 0; row < 4; ++row) {
        const auto [xa, ya, xb, yb, w] = ribs[row];
        patch[row] = {Vec3(xa, ya, 0), Vec3(xa, ya, -w * side), Vec3(xb, yb, -w * side),
                      Vec3(xb, yb, 0)};
        if (side < 0) {  // the mirror image, run across the other way, faces outwards again
          std::swap(patch[row][0], patch[row][3]);
          std::swap(patch[row][1], patch[row][2]);
        }
      }
    }
  }
  return patches;
}

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}

std::array<double, 4> bernstein_derivative(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t};
}

Vec3 evaluate(const Patch& patch, const std::array<double, 4>& along,
              const std::array<double, 4>& across) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      sum += along[row] * across[column] * patch[row][column];
    }
  }
  return sum;
}

// At a pole a whole edge of the patch is one point and the partial derivative across vanishes. All
// rows next to it are level there, so the limit of the normal is the axis.
bool is_pole(const Vec3& position) {
  return position.x() == 0 && position.z() == 0;
}

// The rounding of the weights differs from point to point along an edge that is a pole, and its
// points must be one to the bit.
Vec3 patch_position(const Patch& patch, double u, double v) {
  const Vec3 position = evaluate(patch, bernstein(u), bernstein(v));
  return is_pole(position) ? patch[u < 0.5 ? 0 : 3][0] : position;
}

Vec3 patch_normal(const Patch& patch, double u, double v, const Vec3& position) {
  if (is_pole(position)) {
    return position.y() > 1 ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitY());
  }
  const Vec3 along = evaluate(patch, bernstein_derivative(u), bernstein(v));
  const Vec3 across = evaluate(patch, bernstein(u), bernstein_derivative(v));
  return along.cross(across).normalized();
}

void append_patch(Mesh& mesh, const Patch& patch, std::array<int, 2> segments) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i <= segments[1]; ++i) {
    for (int j = 0; j <= segments[0]; ++j) {
      const double u = static_cast<double>(i) / segments[1];
      const double v = static_cast<double>(j) / segments[0];
      const Vec3 position = patch_position(patch, u, v);
      mesh.positions.push_back(position);
      mesh.normals.push_back(patch_normal(patch, u, v, position));
    }
  }
  const auto columns = static_cast<std::uint32_t>(segments[0]) + 1;
  const auto emit = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const int poles =
        is_pole(mesh.positions[a]) + is_pole(mesh.positions[b]) + is_pole(mesh.positions[c]);
    if (poles < 2) {
      mesh.faces.push_back({{a, b, c}});
    }
  };
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments[1]); ++i) {
    for (std::uint32_t j = 0; j + 1 < columns; ++j) {
      const std::uint32_t corner = base + i * columns + j;
      emit(corner, corner + columns, corner + 1);
      emit(corner + 1, corner + columns, corner + columns + 1);
    }
  }
}

}  // namespace

Mesh make_teapot(std::array<int, 2> segments) {
  Mesh mesh;
  for (const Patch& patch : teapot_patches()) {
    append_patch(mesh, patch, segments);
  }
  return mesh;
}

std::size_t teapot_triangles(std::array<int, 2> segments) {
  const auto across = static_cast<std::size_t>(segments[0]);
  const auto along = static_cast<std::size_t>(segments[1]);
  return across * (2 * kPatches * along - kPolePatches);
}

}  // namespace phongpipe
