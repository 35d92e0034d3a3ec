// Subdivision: pieces that turn less, cover what the whole covered, and shade as it does.
#include "model/scene/subdivision.h"

#include <gtest/gtest.h>

#include "model/fixed/coverage.h"
#include "model/shading/phong.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kSubdivisionSeed = 31;
constexpr int kSize = 48;  // of the image
constexpr double kDegrees = 3.14159265358979323846 / 180;

double turn(const ScreenTriangle& triangle) {
  double least = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = triangle.vertices[i].normal, &b = triangle.vertices[(i + 1) % 3].normal;
    least = std::min(least, a.normalized().dot(b.normalized()));
  }
  return std::acos(least) / kDegrees;
}

// Cells of a grid, each halved, with corners anywhere on the grid of vertices and normals that turn
// up to 90 degrees: split triangles beside whole ones.
Geometry random_mesh(Random& random) {
  constexpr std::size_t kCells = 6, kCell = kSize / kCells;
  constexpr int kGrid = kSubpixels / (1 << kGridBits);
  std::array<std::array<ScreenVertex, kCells + 1>, kCells + 1> corner;
  for (std::size_t row = 0; row <= kCells; ++row) {
    for (std::size_t column = 0; column <= kCells; ++column) {
      ScreenVertex& v = corner[row][column];
      const auto place = [&](std::size_t cell) {
        // Every other coordinate on a pixel's centre or edge, where the rule decides.
        const int step = random.integer(0, 1) == 0 ? kGrid : kSubpixels / 2;
        const int jitter = random.integer(-kSubpixels / step, kSubpixels / step) * step;
        return static_cast<int>(cell * kCell) * kSubpixels + jitter;
      };
      v.x = place(column);
      v.y = place(row);
      v.z = random.uniform(0, 1);
      v.normal = random.unit_near(Vec3(0, 0, 1), 45);
      v.eye = random.unit_near(Vec3(0, 0, 1), 30) * random.uniform(2, 4);
      v.position = Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    }
  }
  Geometry geometry;
  geometry.materials = {grey_material(0.6, 0, 1)};
  for (std::size_t row = 0; row < kCells; ++row) {
    for (std::size_t column = 0; column < kCells; ++column) {
      const ScreenVertex &a = corner[row][column], &b = corner[row][column + 1],
                         &c = corner[row + 1][column + 1], &d = corner[row + 1][column];
      geometry.triangles.push_back({{a, b, c}, 0});
      geometry.triangles.push_back({{d, c, a}, 0});
    }
  }
  return geometry;
}

// How often each pixel is covered by the triangles for which `counts` holds.
template <typename Counts>
std::vector<int> coverage(const Geometry& geometry, Counts counts) {
  std::vector<int> covered(kSize * kSize);
  std::vector<RowSpan> rows;
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    if (!counts(i)) continue;
    cover(geometry.triangles[i], kSize, kSize, rows);
    for (const RowSpan& row : rows) {
      for (int x = row.x; x < row.x + row.length; ++x) {
        ++covered[static_cast<std::size_t>(row.y * kSize + x)];
      }
    }
  }
  return covered;
}

TEST(Subdivision, SplitsInFourWhatTurnsByMoreThanTheLimit) {
  SCOPED_TRACE(kSubdivisionSeed);
  Random random(kSubdivisionSeed);
  const Geometry geometry = random_mesh(random);
  const Subdivision result = subdivide(lit_scene(kSize, kSize), geometry, 40);
  ASSERT_EQ(result.geometry.triangles.size(), result.whole.size());
  std::vector<std::size_t> pieces(geometry.triangles.size());
  for (const std::uint32_t whole : result.whole) ++pieces[whole];
  std::size_t split = 0, made = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i] > 1, turn(geometry.triangles[i]) > 40) << "triangle " << i;
    EXPECT_EQ(pieces[i] % 3, 1U);
    split += pieces[i] > 1 ? 1 : 0;
    made += pieces[i] > 1 ? pieces[i] : 0;
  }
  EXPECT_GT(split, 0U);
  EXPECT_LT(split, pieces.size());
  EXPECT_EQ(result.split, split);
  EXPECT_EQ(result.pieces, made);
  for (const ScreenTriangle& piece : result.geometry.triangles) EXPECT_LE(turn(piece), 40);
}

// A highlight of this power fades below an LSB 20 degrees from its middle.
TEST(Subdivision, WhereAHighlightFallsTheLimitIsHowFarItReaches) {
  SCOPED_TRACE(kSubdivisionSeed);
  Random random(kSubdivisionSeed);
  constexpr double kPower = 89;
  const double reach = std::acos(std::pow(1.0 / 255, 1 / kPower)) / kDegrees;
  EXPECT_NEAR(reach, 20, 0.1);
  Geometry geometry = random_mesh(random);
  geometry.materials = {grey_material(0.6, 0.3, kPower)};
  const Scene scene = lit_scene(kSize, kSize);
  const Subdivision result = subdivide(scene, geometry, 60);
  const auto from_highlight = [&scene](const ScreenVertex& v) {
    const Vec3 halfway = (v.eye.normalized() - scene.lights[0].direction).normalized();
    return std::acos(v.normal.normalized().dot(halfway)) / kDegrees;
  };
  int lit = 0, dark = 0;
  for (const ScreenTriangle& piece : result.geometry.triangles) {
    double nearest = 180;
    for (const ScreenVertex& v : piece.vertices) nearest = std::min(nearest, from_highlight(v));
    if (nearest < reach) {
      EXPECT_LE(turn(piece), reach);
      ++lit;
    } else if (turn(piece) > reach) {
      ++dark;
    }
  }
  EXPECT_GT(lit, 0);
  EXPECT_GT(dark, 0);
}

// A flat triangle under a lamp: split where the light's directions turn too far, and under a narrow
// cone before that.
TEST(Subdivision, LightCloseByHasALimitOfItsOwn) {
  Scene scene = lit_scene(kSize, kSize);
  Light& light = scene.lights[0];
  light.type = LightType::spot;
  light.direction = Vec3(0, 0, -1);
  Geometry geometry;
  geometry.materials = {grey_material(0.6, 0, 1)};
  ScreenTriangle flat;
  const std::array<Vec3, 3> corners = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};
  for (std::size_t i = 0; i < 3; ++i) {
    ScreenVertex& v = flat.vertices[i];
    v.position = corners[i];
    v.x = static_cast<int>((corners[i].x() + 1.5) * 16 * kSubpixels);
    v.y = static_cast<int>((corners[i].y() + 1.5) * 16 * kSubpixels);
    v.normal = v.eye = Vec3(0, 0, 1);
  }
  geometry.triangles = {flat};
  const auto pieces = [&](double height, double exponent) {
    light.position = Vec3(0, 0, height);
    light.spot_exponent = exponent;
    return subdivide(scene, geometry, 45).geometry.triangles.size();
  };
  EXPECT_EQ(pieces(10, 0), 1U);   // directions turn by 13°
  EXPECT_EQ(pieces(4, 0), 4U);    // by 33°
  EXPECT_EQ(pieces(10, 89), 4U);  // a power that reaches 20°
  light.type = LightType::directional;
  EXPECT_EQ(pieces(4, 89), 1U);
}

TEST(Subdivision, ZeroIsNever) {
  SCOPED_TRACE(kSubdivisionSeed);
  Random random(kSubdivisionSeed);
  const Geometry geometry = random_mesh(random);
  const Subdivision result = subdivide(lit_scene(kSize, kSize), geometry, 0);
  EXPECT_EQ(result.geometry.triangles.size(), geometry.triangles.size());
  EXPECT_EQ(result.split, 0U);
  EXPECT_EQ(result.pieces, 0U);
}

TEST(Subdivision, EndsAtTheFinestLevel) {
  SCOPED_TRACE(kSubdivisionSeed);
  Random random(kSubdivisionSeed);
  Geometry geometry = random_mesh(random);
  geometry.triangles.resize(1);
  for (std::size_t i = 0; i < 3; ++i) {
    geometry.triangles[0].vertices[i].normal = Vec3::Unit(static_cast<Eigen::Index>(i));
  }
  EXPECT_EQ(subdivide(lit_scene(kSize, kSize), geometry, 1).pieces, 64U);
}

TEST(Subdivision, PiecesCoverThePixelsOfTheWholeEachOnce) {
  SCOPED_TRACE(kSubdivisionSeed);
  Random random(kSubdivisionSeed);
  for (int i = 0; i < 40; ++i) {
    const Geometry geometry = random_mesh(random);
    const Subdivision result = subdivide(lit_scene(kSize, kSize), geometry, i % 2 == 0 ? 40 : 15);
    for (std::uint32_t whole = 0; whole < geometry.triangles.size(); ++whole) {
      ASSERT_EQ(coverage(result.geometry,
                         [&](std::uint32_t piece) { return result.whole[piece] == whole; }),
                coverage(geometry, [&](std::uint32_t triangle) { return triangle == whole; }))
          << "mesh " << i << ", triangle " << whole;
    }
  }
}

// The reference is the same function, for an eye and a light at a distance too.
TEST(Subdivision, ExactPhongShadingIsThatOfTheWhole) {
  SCOPED_TRACE(kSubdivisionSeed);
  Random random(kSubdivisionSeed);
  Geometry geometry = random_mesh(random);
  geometry.materials = {grey_material(0.6, 0.3, 20)};
  Scene scene = lit_scene(kSize, kSize);
  scene.shading.viewer = Viewer::local;
  scene.lights.front().type = LightType::point;
  scene.lights.front().position = Vec3(1, 2, 5);
  const Subdivision result = subdivide(scene, geometry, 20);
  std::vector<RowSpan> rows;
  std::array<Color, kSize> expected, actual;
  for (std::uint32_t i = 0; i < result.whole.size(); ++i) {
    const ScreenTriangle& piece = result.geometry.triangles[i];
    const PhongTriangle whole(scene, geometry.materials[0], geometry.triangles[result.whole[i]]);
    const PhongTriangle part(scene, geometry.materials[0], piece);
    cover(piece, kSize, kSize, rows);
    for (const RowSpan& row : rows) {
      whole.shade(row.x, row.y, row.length, expected.data());
      part.shade(row.x, row.y, row.length, actual.data());
      for (std::size_t k = 0; k < static_cast<std::size_t>(row.length); ++k) {
        EXPECT_NEAR(actual[k][0], expected[k][0], 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace phongpipe
