// The edge of a spotlight's cone: rows are cut where pixel centres leave it, nothing is lost or
// doubled, and where the whole triangle is inside nothing is cut.
#include "model/fixed/cone.h"

#include <gtest/gtest.h>

#include <string>

#include "model/fixed/front_end.h"
#include "model/fixed/model_frame.h"
#include "model/shading/phong.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kConeFirstSeed = 211;
constexpr unsigned kSeeds = 4000;

// Above the plane of random_triangle's positions, which are all near (0, 0, −½): they are moved to
// where they are on the screen, 100 pixels to a unit.
ScreenTriangle placed(ScreenTriangle triangle) {
  for (ScreenVertex& v : triangle.vertices) {
    v.position.x() = in_pixels(v.x) / 100;
    v.position.y() = -in_pixels(v.y) / 100;
  }
  return triangle;
}

Light random_spot(Random& random) {
  Light light;
  light.type = LightType::spot;
  light.position =
      Vec3{random.uniform(-0.5, 1.5), random.uniform(-1.5, 0.5), random.uniform(0.3, 2)};
  light.direction = random.unit_near(Vec3(0, 0, -1), 60);
  light.spot_cutoff_degrees = random.uniform(2, 90);
  return light;
}

// By barycentric coordinates in long double, written down apart from the interpolator.
class CenterAngles {
 public:
  CenterAngles(const Light& light, const ScreenTriangle& triangle)
      : light_(light), v_(triangle.vertices) {}

  // Cosine between −direction and the vector from a pixel's centre to the light, less the cutoff's.
  long double beyond_cutoff(int x, int y) const {
    const long double px = x + 0.5L, py = y + 0.5L;
    const auto area = [&](long double ax, long double ay, long double bx, long double by) {
      return (bx - ax) * (py - ay) - (by - ay) * (px - ax);
    };
    std::array<long double, 3> weight;
    long double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const ScreenVertex &a = v_[(i + 1) % 3], &b = v_[(i + 2) % 3];
      weight[i] = area(in_pixels(a.x), in_pixels(a.y), in_pixels(b.x), in_pixels(b.y));
      sum += weight[i];
    }
    long double along = 0, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      long double component = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        component += weight[i] / sum * (light_.position[axis] - v_[i].position[axis]);
      }
      along -= component * light_.direction[axis];
      square += component * component;
    }
    const long double cutoff = std::cos(light_.spot_cutoff_degrees * 3.14159265358979323846L / 180);
    return std::max(0.0L, along / std::sqrt(square)) - cutoff;
  }

 private:
  const Light& light_;
  const std::array<ScreenVertex, 3>& v_;
};

bool all_corners_inside(const Light& light, const ScreenTriangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(), [&](const auto& vertex) {
    return in_cone(light, light_vector(light, vertex).normalized());
  });
}

TEST(Cone, PartsRowsWherePixelCentersLeaveIt) {
  // Double against long double; a centre so near to the cone's surface may be either way.
  constexpr long double kNoise = 1e-12L;
  std::size_t inside = 0, outside = 0, cut = 0, whole = 0;
  for (unsigned seed = kConeFirstSeed; seed < kConeFirstSeed + kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Scene scene = lit_scene(100, 100);
    const ScreenTriangle triangle =
        placed(random_triangle(random, scene.image, random.uniform(2, 40)));
    const Light light = random_spot(random);
    std::vector<RowSpan> rows;
    cover(triangle, 100, 100, rows);
    std::vector<RowSpan> pieces = rows;
    split_at_cone(light, triangle, pieces);
    const CenterAngles angles(light, triangle);
    std::size_t next = 0;
    for (const RowSpan& row : rows) {
      int x = row.x, lit_pieces = 0;
      bool before = false;
      for (; x < row.x + row.length; ++next) {
        ASSERT_LT(next, pieces.size()) << "row " << row.y << " ends early";
        const RowSpan& piece = pieces[next];
        ASSERT_EQ(piece.y, row.y);
        ASSERT_EQ(piece.x, x) << "a gap or an overlap in row " << row.y;
        ASSERT_GT(piece.length, 0);
        ASSERT_TRUE(x == row.x || piece.lit != before) << "cut where nothing changes";
        before = piece.lit;
        lit_pieces += piece.lit;
        for (; x < piece.x + piece.length; ++x) {
          const long double beyond = angles.beyond_cutoff(x, row.y);
          if (std::fabs(beyond) < kNoise) continue;
          ASSERT_EQ(piece.lit, beyond > 0) << "pixel " << x << ", " << row.y;
          ++(piece.lit ? inside : outside);
        }
      }
      ASSERT_EQ(x, row.x + row.length);
      ASSERT_LE(lit_pieces, 1) << "a cone is convex";
    }
    ASSERT_EQ(next, pieces.size());
    cut += pieces.size() > rows.size();
    if (all_corners_inside(light, triangle)) {
      ASSERT_EQ(pieces.size(), rows.size());
      ++whole;
    }
  }
  for (const std::size_t count : {inside, outside}) EXPECT_GT(count, 100'000U);
  for (const std::size_t count : {cut, whole}) EXPECT_GT(count, 200U);
}

TEST(Cone, OfAPointLightIsEverywhere) {
  Random random(kConeFirstSeed);
  Light light = random_spot(random);
  light.type = LightType::point;
  const ScreenTriangle triangle = placed(random_triangle(random, lit_scene(100, 100).image, 30));
  std::vector<RowSpan> rows;
  cover(triangle, 100, 100, rows);
  std::vector<RowSpan> pieces = rows;
  split_at_cone(light, triangle, pieces);
  ASSERT_EQ(pieces.size(), rows.size());
  EXPECT_TRUE(
      std::all_of(pieces.begin(), pieces.end(), [](const RowSpan& row) { return row.lit; }));
}

// Whether the light is the first, which writes, or a further one, which adds.
TEST(Cone, OutsideAPictureIsThatWithoutTheLight) {
  for (unsigned seed = kConeFirstSeed; seed < kConeFirstSeed + 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Scene scene = lit_scene(100, 100);
    Geometry geometry = random_geometry(random, scene, 12, 40);
    for (ScreenTriangle& triangle : geometry.triangles) triangle = placed(triangle);
    Light spot = random_spot(random);
    spot.spot_cutoff_degrees = random.uniform(5, 40);
    const auto frame_of = [&geometry](const Scene& described, const auto& visit) {
      const FrameSetup frame(described, geometry, FrameConfiguration());
      visit(frame, run_model(frame));
    };
    const auto colors = [&](const Scene& described) {
      std::vector<std::uint32_t> result;
      frame_of(described, [&](const FrameSetup&, const ModelFrame& m) { result = m.colors(); });
      return result;
    };
    // Black where it is the first: the lights are rounded one by one.
    Scene black = scene, first = scene, further = scene;
    black.lights.insert(black.lights.begin(), spot);
    black.lights.front().color = Color::Zero();
    first.lights.insert(first.lights.begin(), spot);
    further.lights.push_back(spot);
    for (const bool is_first : {true, false}) {
      const Scene& lit = is_first ? first : further;
      const std::vector<std::uint32_t> without = colors(is_first ? black : scene);
      std::size_t outside = 0, changed = 0;
      frame_of(lit, [&](const FrameSetup& frame, const ModelFrame& model) {
        const std::vector<std::uint32_t> with = model.colors();
        for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
          const CenterAngles angles(spot, geometry.triangles[t]);
          std::vector<RowSpan> rows;
          cover(geometry.triangles[t], frame.width, frame.height, rows);
          for (const RowSpan& row : rows) {
            for (int x = row.x; x < row.x + row.length; ++x) {
              const auto index = static_cast<std::size_t>(row.y * frame.width + x);
              if (!model.framebuffer.owned(index, t)) continue;
              if (angles.beyond_cutoff(x, row.y) < -1e-12L) {
                ASSERT_EQ(with[index], without[index]) << "pixel " << x << ", " << row.y;
                ++outside;
              } else {
                changed += with[index] != without[index];
              }
            }
          }
        }
      });
      EXPECT_GT(outside + changed, 100U);
    }
  }
}

}  // namespace
}  // namespace phongpipe
