// What rounding leaves of the equality of neighbours' six-point series on the edge they share.
#include <gtest/gtest.h>

#include "model/fixed/front_end.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kSeamSeed = 41;
constexpr int kSize = 64;  // of the image
constexpr int kSteps = 8;  // pixel centres on the edge, beside its first end

// Two triangles on both sides of an edge that leads from pixel centre to pixel centre.
struct Neighbours {
  Geometry geometry;
  int x, y, dx, dy;  // the edge's first pixel, and from one to the next

  explicit Neighbours(Random& random) : geometry() {
    const auto vertex = [&random](int px, int py) {
      ScreenVertex v;
      v.x = px * kSubpixels + kSubpixels / 2;
      v.y = py * kSubpixels + kSubpixels / 2;
      v.normal = random.unit_near(Vec3(0, 0, 1), 25);
      v.eye = random.unit_near(Vec3(0, 0, 1), 20) * random.uniform(2, 4);
      return v;
    };
    x = random.integer(28, 34);
    y = random.integer(4, 8);
    dx = random.integer(-1, 1);
    dy = random.integer(3, 6);
    const ScreenVertex from = vertex(x, y), to = vertex(x + kSteps * dx, y + kSteps * dy);
    const int left_x = random.integer(0, 8), left_y = random.integer(0, kSize - 1);
    const int right_x = random.integer(54, 62), right_y = random.integer(0, kSize - 1);
    const ScreenVertex left = vertex(left_x, left_y), right = vertex(right_x, right_y);
    geometry.materials = {grey_material(0.9, 0.5, 20)};
    geometry.triangles = {{{from, to, left}, 0}, {{right, to, from}, 0}};
  }
};

// Largest difference between both series at the edge's pixels, in units of `fraction_bits`.
template <typename SeriesOf>
std::int64_t largest_seam(const Neighbours& n, const std::array<TriangleWork, 2>& work,
                          int dropped_bits, SeriesOf series_of) {
  std::int64_t largest = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const auto value = [&](const TriangleSetup& setup) {
      return round_off(series_of(setup).value(n.x + i * n.dx - setup.x, n.y + i * n.dy - setup.y),
                       dropped_bits);
    };
    largest =
        std::max<std::int64_t>(largest, std::llabs(value(work[0].setup) - value(work[1].setup)));
  }
  return largest;
}

struct Seams {
  std::int64_t diffuse = 0, specular = 0;  // in LSB of their registers
};

Seams largest_seams(SeriesFit fit, Anchor anchor, Viewer viewer) {
  Random random(kSeamSeed);
  Scene scene = lit_scene(kSize, kSize);
  scene.shading.viewer = viewer;
  FrameConfiguration configuration;
  configuration.series_fit = fit;
  configuration.anchor = anchor;
  Seams largest;
  for (int i = 0; i < 300; ++i) {
    const Neighbours neighbours(random);
    const FrameSetup frame(scene, neighbours.geometry, configuration);
    const FrontEnd front_end(frame);
    std::array<TriangleWork, 2> work;
    for (std::uint32_t t = 0; t < 2; ++t) {
      EXPECT_EQ(front_end.set_up(t, 0, work[t]), SetupOutcome::ready);
    }
    const int dropped = setup_fraction_bits(configuration, 0);
    largest.diffuse = std::max(
        largest.diffuse, largest_seam(neighbours, work, dropped,
                                      [](const TriangleSetup& setup) { return setup.diffuse[0]; }));
    largest.specular = std::max(
        largest.specular, largest_seam(neighbours, work, dropped,
                                       [](const TriangleSetup& setup) { return setup.specular; }));
  }
  return largest;
}

// Rounded at the start of each span, both sides round the same number.
TEST(Seam, OfSixPointIsAtMostALsbOfTheRegister) {
  SCOPED_TRACE(kSeamSeed);
  for (const Viewer viewer : {Viewer::infinite, Viewer::local}) {
    const Seams seams = largest_seams(SeriesFit::six_point, Anchor::span, viewer);
    EXPECT_LE(seams.diffuse, 1);
    EXPECT_LE(seams.specular, 1);
  }
}

// Rounded once a triangle, errors grow with its extent; an LSB of the output, or an address of the
// table, they do not reach.
TEST(Seam, OfSixPointRoundedOnceIsLessThanALsbOfTheOutput) {
  SCOPED_TRACE(kSeamSeed);
  const FrameConfiguration configuration;
  const Seams seams = largest_seams(SeriesFit::six_point, Anchor::triangle, Viewer::infinite);
  EXPECT_LT(seams.diffuse, 1 << configuration.diffuse_fraction_bits);
  EXPECT_LT(seams.specular, 1 << configuration.specular_fraction_bits);
}

// The measure sees seams where there are some.
TEST(Seam, OfTaylorIsMoreThanALsbOfTheOutput) {
  SCOPED_TRACE(kSeamSeed);
  const FrameConfiguration configuration;
  const Seams seams = largest_seams(SeriesFit::taylor, Anchor::span, Viewer::infinite);
  EXPECT_GT(seams.diffuse, 1 << configuration.diffuse_fraction_bits);
}

}  // namespace
}  // namespace phongpipe
