// What better quadratics are worth where the series matters: on coarse meshes, in real arithmetic,
// diffuse light and highlights by themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "model/fixed/front_end.h"
#include "model/shading/phong.h"

namespace phongpipe {
namespace {

struct CoarseMesh {
  const char* primitive;
  std::array<int, 2> segments;
  Vec3 eye, target;
  double extent;
};

// Beyond, the best quadratic is tens of LSB off: such triangles, the rims of the teapot, are to be
// subdivided.
constexpr double kLargestTurn = 90;

const std::array<CoarseMesh, 3> kMeshes = {{
    {"pawn", {24, 12}, Vec3(0, 2.3, 6), Vec3(0, 0.94, 0), 2.4},
    {"teapot", {4, 4}, Vec3(2.2, 4.6, 8.6), Vec3(0.36, 1.42, 0), 6},
    {"sphere", {16, 8}, Vec3(0, 1, 5), Vec3(0, 0, 0), 2.2},
}};

Scene scene_of(const CoarseMesh& mesh, const Vec3& light) {
  Scene scene;
  scene.image.width = scene.image.height = 512;
  scene.camera.projection = Projection::orthographic;
  scene.camera.eye = mesh.eye;
  scene.camera.target = mesh.target;
  scene.camera.vertical_extent = mesh.extent;
  scene.lights.emplace_back();
  scene.lights.front().direction = light.normalized();
  scene.objects.emplace_back();
  scene.objects.front().name = mesh.primitive;
  scene.objects.front().segments = mesh.segments;
  return scene;
}

Material material_of(double power) {  // 0: diffuse light
  Material material;
  material.ambient = Color::Zero();
  material.diffuse = Color::Constant(power == 0 ? 1 : 0);
  material.specular = Color::Constant(power == 0 ? 0 : 1);
  material.shininess = power == 0 ? 1 : power;
  return material;
}

// Largest angle between two normals of a triangle, in degrees.
double turn(const ScreenTriangle& triangle) {
  double least = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = triangle.vertices[i].normal, &b = triangle.vertices[(i + 1) % 3].normal;
    least = std::min(least, a.normalized().dot(b.normalized()));
  }
  return std::acos(least) * 180 / 3.14159265358979323846;
}

// Largest error in LSB over all pixels of all triangles that face the eye and turn by at most
// kLargestTurn.
double largest_error(const Scene& scene, Geometry geometry, double power, SeriesFit fit) {
  geometry.materials = {material_of(power)};
  DatapathConfiguration configuration;
  configuration.series_fit = fit;
  configuration.gate = GateSource::series;
  const FrameSetup frame(scene, geometry, configuration, 24);
  const FrontEnd front_end(frame, geometry);
  const SetupEngine engine(frame, geometry);
  TriangleWork work;
  std::vector<Color> exact(512);
  double largest = 0;
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    if (turn(geometry.triangles[i]) > kLargestTurn || !front_end.set_up(i, work)) continue;
    const TriangleCoefficients<double> series = engine.coefficients(i, work.setup.x, work.setup.y);
    const PhongTriangle phong(scene, geometry.materials[0], geometry.triangles[i]);
    for (const RowSpan& row : work.rows) {
      phong.shade(row.x, row.y, row.length, exact.data());
      for (int k = 0; k < row.length; ++k) {
        const double x = row.x + k - work.setup.x, y = row.y - work.setup.y;
        const double cosine = series.specular(x, y) / configuration.rom_words();
        const double highlight =
            series.gate(x, y) > 0 ? std::pow(std::min(1.0, std::max(0.0, cosine)), power) : 0;
        const double shaded =
            power == 0 ? std::min(255.0, std::max(0.0, series.diffuse[0](x, y))) : 255 * highlight;
        largest = std::max(largest, std::fabs(shaded - exact[static_cast<std::size_t>(k)][0]));
      }
    }
  }
  return largest;
}

constexpr std::array<SeriesFit, 4> kFits = {SeriesFit::taylor, SeriesFit::six_point,
                                            SeriesFit::weighted, SeriesFit::focused};

// By mesh and fit, the largest under three lights.
std::array<double, 4> errors_of(const CoarseMesh& mesh, double power) {
  std::array<double, 4> errors = {};
  for (const Vec3& light : {Vec3(-0.6, -0.6, -0.8), Vec3(0.55, -0.75, -0.7), Vec3(0.1, -0.2, -1)}) {
    const Scene scene = scene_of(mesh, light);
    const Geometry geometry = make_geometry(scene);
    for (std::size_t f = 0; f < kFits.size(); ++f) {
      errors[f] = std::max(errors[f], largest_error(scene, geometry, power, kFits[f]));
    }
  }
  std::printf(
      "%-7s %s %3g: largest error taylor %.2f, six-point %.2f, weighted %.2f, focused %.2f\n",
      mesh.primitive, power == 0 ? "diffuse " : "specular", power, errors[0], errors[1], errors[2],
      errors[3]);
  return errors;
}

TEST(CoarseMesh, DiffuseErrorIsAFractionOfTaylors) {
  for (const CoarseMesh& mesh : kMeshes) {
    const std::array<double, 4> errors = errors_of(mesh, 0);
    EXPECT_LE(errors[1], errors[0] / 3) << mesh.primitive;
    EXPECT_LE(errors[2], errors[0] / 4) << mesh.primitive;
    EXPECT_LE(errors[3], errors[0] / 4) << mesh.primitive;
  }
}

TEST(CoarseMesh, HighlightErrorIsAtMostHalfOfTaylors) {
  for (const double power : {20.0, 164.0}) {
    for (const CoarseMesh& mesh : kMeshes) {
      const std::array<double, 4> errors = errors_of(mesh, power);
      EXPECT_LE(errors[3], errors[0] / 2) << mesh.primitive << ", power " << power;
    }
  }
}

}  // namespace
}  // namespace phongpipe
