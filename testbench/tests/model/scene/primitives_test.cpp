#include "model/scene/primitives.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <tuple>

namespace phongpipe {
namespace {

using Point = std::tuple<double, double, double>;

Point point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh make(const std::string& name) {
  const Primitive& primitive = *find_primitive(name);
  return primitive.make(primitive.default_segments);
}

// The edges that are not met by the same edge in the other direction. Positions are compared to the
// bit: a difference in the last one could open a crack after snapping.
std::vector<std::pair<Point, Point>> open_edges(const Mesh& mesh) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const MeshFace& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point from = point(mesh.positions[face.vertices[i]]);
      const Point to = point(mesh.positions[face.vertices[(i + 1) % 3]]);
      const auto opposite = edges.find({to, from});
      if (opposite == edges.end()) {
        ++edges[{from, to}];
      } else if (--opposite->second == 0) {
        edges.erase(opposite);
      }
    }
  }
  std::vector<std::pair<Point, Point>> open;
  for (const auto& [edge, count] : edges) {
    open.push_back(edge);
  }
  return open;
}

class EveryPrimitive : public ::testing::TestWithParam<Primitive> {};

TEST_P(EveryPrimitive, EmitsTheTrianglesItSays) {
  const Primitive& primitive = GetParam();
  for (const Segments segments :
       {primitive.min_segments, primitive.default_segments, Segments{7, 5}}) {
    const Mesh mesh = primitive.make(segments);
    EXPECT_EQ(mesh.faces.size(), primitive.triangles(segments));
    ASSERT_EQ(mesh.positions.size(), mesh.normals.size());
    for (const MeshFace& face : mesh.faces) {
      for (const std::uint32_t vertex : face.vertices) {
        ASSERT_LT(vertex, mesh.positions.size());
      }
      ASSERT_GT(face_area_vector(mesh, face).norm(), 0);
    }
  }
}

TEST_P(EveryPrimitive, HasUnitNormalsThatAgreeWithTheFaces) {
  const Primitive& primitive = GetParam();
  const Mesh mesh = primitive.make(primitive.default_segments);
  for (const MeshFace& face : mesh.faces) {
    const Vec3 geometric = face_area_vector(mesh, face).normalized();
    for (const std::uint32_t vertex : face.vertices) {
      ASSERT_NEAR(mesh.normals[vertex].norm(), 1, 1e-12);
      ASSERT_GT(mesh.normals[vertex].dot(geometric), 0)
          << "at " << mesh.positions[vertex].transpose();
    }
  }
}

// Where vertices coincide, the surface is smooth across the seam. The foot of the teapot's handle
// touches a vertex of the pot, which is no seam.
TEST_P(EveryPrimitive, HasOneNormalAtEachPoint) {
  const Mesh mesh = GetParam().make(GetParam().default_segments);
  std::map<Point, Vec3> normals;
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (mesh.positions[vertex] == Vec3(-2, 0.9, 0)) {
        continue;
      }
      const auto [entry, is_new] =
          normals.try_emplace(point(mesh.positions[vertex]), mesh.normals[vertex]);
      ASSERT_LT((entry->second - mesh.normals[vertex]).norm(), 1e-9)
          << "at " << mesh.positions[vertex].transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryPrimitive, ::testing::ValuesIn(primitives()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Primitives, UnknownNameIsNull) {
  EXPECT_EQ(find_primitive("cube"), nullptr);
}

TEST(Primitives, SphereAndTorusAreClosed) {
  EXPECT_TRUE(open_edges(make("sphere")).empty());
  EXPECT_TRUE(open_edges(make("torus")).empty());
}

TEST(Primitives, SphereNormalsArePositions) {
  const Mesh mesh = make("sphere");
  EXPECT_EQ(mesh.faces.size(), 2U * 64 * 31);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_LT((mesh.positions[i] - mesh.normals[i]).norm(), 1e-15);
  }
}

TEST(Primitives, PlaneFacesUpAndIsTwoByTwo) {
  const Mesh mesh = find_primitive("plane")->make({3, 2});
  double area = 0;
  for (const MeshFace& face : mesh.faces) {
    const Vec3 area_vector = face_area_vector(mesh, face);
    EXPECT_GT(area_vector.y(), 0);
    area += area_vector.norm() / 2;
  }
  EXPECT_NEAR(area, 4, 1e-12);
}

TEST(Primitives, PawnHasThePapersTriangles) {
  const Mesh mesh = make("pawn");
  EXPECT_EQ(mesh.faces.size(), 14620U);
  const auto open = open_edges(mesh);
  EXPECT_EQ(open.size(), 2U * 170) << "the rings at the top and the foot, nothing else";
  double lowest = 1;
  double highest = 1;
  double top_radius = 1;
  for (const Vec3& p : mesh.positions) {
    lowest = std::min(lowest, p.y());
    highest = std::max(highest, p.y());
    top_radius = std::min(top_radius, std::hypot(p.x(), p.z()));
  }
  EXPECT_NEAR(lowest, 0, 1e-12);
  EXPECT_NEAR(highest, 2, 1e-3);
  EXPECT_NEAR(top_radius, 1e-4, 1e-9);
}

TEST(Teapot, CountsTrianglesWithoutThePoles) {
  // 32 patches of 2 n², less n for each of the 8 patches at a pole, as in Haines's SPD.
  EXPECT_EQ(find_primitive("teapot")->triangles({2, 2}), 240U);
  EXPECT_EQ(make("teapot").faces.size(), 6320U);
}

TEST(Teapot, HasNewellsExtent) {
  const Mesh mesh = find_primitive("teapot")->make({16, 16});
  Vec3 low = mesh.positions[0];
  Vec3 high = mesh.positions[0];
  for (const Vec3& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_NEAR(low.x(), -3, 1e-2) << "the handle";
  EXPECT_NEAR(high.x(), 3.434, 1e-2) << "the spout";
  EXPECT_NEAR(low.y(), 0, 1e-12);
  EXPECT_NEAR(high.y(), 3.15, 1e-12);
  EXPECT_NEAR(high.z(), 2, 1e-2);
  EXPECT_EQ(low.z(), -high.z());
}

// Nothing is open but what Newell left open: the rim's inner edge, the lid's, and both ends of
// handle and spout.
TEST(Teapot, IsWatertightButForNewellsOpenings) {
  std::map<std::string, int> openings;
  for (const auto& [from, to] : open_edges(make("teapot"))) {
    const auto [x, y, z] = from;
    const double radius = std::hypot(x, z);
    if (std::abs(y - 2.4) < 1e-12 && x < 2.5) {
      ++openings[radius > 1.35 ? "rim" : "lid"];
    } else {
      ++openings[x < -1.8 ? "handle foot" : x < 0 ? "handle top" : x < 2 ? "spout foot" : "spout"];
    }
  }
  const std::map<std::string, int> expected = {{"rim", 40},        {"lid", 40},
                                               {"handle top", 20}, {"handle foot", 20},
                                               {"spout foot", 20}, {"spout", 20}};
  EXPECT_EQ(openings, expected);
}

TEST(Teapot, PolesPointAlongTheAxis) {
  const Mesh mesh = make("teapot");
  int poles = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    if (p.x() == 0 && p.z() == 0) {
      EXPECT_EQ(mesh.normals[i], Vec3(0, p.y() > 1 ? 1 : -1, 0));
      ++poles;
    } else if (std::hypot(p.x(), p.z()) < 0.16 && p.y() > 3.1) {
      EXPECT_GT(mesh.normals[i].y(), 0.7) << "next to the pole the normal is close to it";
    }
  }
  EXPECT_EQ(poles, 8 * 11);
}

}  // namespace
}  // namespace phongpipe
