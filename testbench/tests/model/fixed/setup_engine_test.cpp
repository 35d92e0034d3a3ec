// setup_engine: each coefficient is rounded once, to nearest, and what does not fit is reported.
#include "model/fixed/setup_engine.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

constexpr unsigned kSetupEngineSeed = 29;

// In units of the fixed-point number, 2^−fraction_bits.
void expect_rounded(std::int64_t fixed, double real, int fraction_bits, const std::string& what) {
  const long double exact = std::ldexp(static_cast<long double>(real), fraction_bits);
  const long double error = std::fabs(static_cast<long double>(fixed) - exact);
  EXPECT_LE(error, 0.5L) << what << ": " << fixed << ", exactly " << static_cast<double>(exact);
}

void expect_rounded(const FixedQuadratic& fixed, const Quadratic<double>& real, int fraction_bits,
                    const std::string& what) {
  const std::array<std::int64_t, 6> t = {fixed.t0, fixed.t1, fixed.t2,
                                         fixed.t3, fixed.t4, fixed.t5};
  const std::array<double, 6> exact = {real.t0, real.t1, real.t2, real.t3, real.t4, real.t5};
  for (std::size_t i = 0; i < 6; ++i) {
    expect_rounded(t[i], exact[i], fraction_bits, what + " T" + std::to_string(i));
  }
}

void expect_rounded(const FixedLinear& fixed, const Linear<double>& real, int fraction_bits,
                    const std::string& what) {
  expect_rounded(fixed.c, real.c, fraction_bits, what);
  expect_rounded(fixed.a, real.a, fraction_bits, what + " along x");
  expect_rounded(fixed.b, real.b, fraction_bits, what + " along y");
}

TEST(SetupEngine, RoundsEachCoefficientToNearest) {
  SCOPED_TRACE(kSetupEngineSeed);
  Random random(kSetupEngineSeed);
  for (const Anchor anchor : {Anchor::triangle, Anchor::span}) {
    for (const Viewer viewer : {Viewer::infinite, Viewer::local}) {
      Scene scene = lit_scene(200, 200);
      scene.shading.viewer = viewer;
      scene.depth_cue = DepthCue{5.2, 5.7, Color::Zero()};
      const Geometry geometry = random_geometry(random, scene, 100, 30);
      FrameConfiguration configuration;
      configuration.channels = 3;
      configuration.gate = GateSource::series;
      configuration.depth_cue = true;
      configuration.anchor = anchor;
      configuration.diffuse_fraction_bits = random.integer(4, 30);
      configuration.specular_fraction_bits = random.integer(1, 25);
      const FrameSetup frame(scene, geometry, configuration);
      const SetupEngine engine(frame);
      const int extra = anchor == Anchor::span ? 20 : 0;
      const int diffuse_bits = configuration.diffuse_fraction_bits + extra;
      for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const int x = random.integer(0, 199), y = random.integer(0, 199);
        const TriangleCoefficients<double> real = engine.coefficients(i, 0, x, y);
        TriangleSetup setup = engine.set_up(i, 0, x, y, 1);
        EXPECT_FALSE(setup.overflow);
        EXPECT_EQ(setup.x, x);
        EXPECT_EQ(setup.y, y);
        EXPECT_EQ(setup.triangle, i);
        EXPECT_EQ(setup.pass, 0U);
        EXPECT_EQ(setup.material, &frame.material(0, geometry.triangles[i].material));
        const std::string which = "triangle " + std::to_string(i);
        for (std::size_t c = 0; c < 3; ++c) {
          // The level is folded into T0, after rounding.
          setup.diffuse[c].t0 -= setup.material->level[c] << extra;
          expect_rounded(setup.diffuse[c], real.diffuse[c], diffuse_bits, which + " diffuse");
        }
        expect_rounded(setup.gate, real.gate, diffuse_bits, which + " gate");
        expect_rounded(setup.specular, real.specular, configuration.specular_fraction_bits + extra,
                       which + " specular");
        expect_rounded(setup.depth, real.depth, 16, which + " depth");
        expect_rounded(setup.cue_factor, real.cue_factor, kCueFraction + extra, which + " share");
      }
    }
  }
}

// A flat triangle that faces the light: every number can be computed by hand.
TEST(SetupEngine, ScalesSeriesToTheirOutputs) {
  Scene scene = lit_scene(64, 64);
  scene.lights.front().direction = Vec3(0, 0, -1);
  Geometry geometry;
  geometry.materials = {grey_material(0.5, 0.25, 20)};
  geometry.triangles.emplace_back();
  const std::array<std::array<int, 2>, 3> corners = {{{0, 0}, {32, 0}, {0, 32}}};
  for (std::size_t i = 0; i < 3; ++i) {
    ScreenVertex& vertex = geometry.triangles[0].vertices[i];
    vertex.x = corners[i][0] * kSubpixels;
    vertex.y = corners[i][1] * kSubpixels;
    vertex.z = corners[i][0];
    vertex.normal = vertex.eye = Vec3(0, 0, 1);
  }
  FrameConfiguration configuration;
  configuration.anchor = Anchor::triangle;
  configuration.gate = GateSource::series;
  const FrameSetup frame(scene, geometry, configuration, Effects::all);  // depth included
  const TriangleSetup setup = SetupEngine(frame).set_up(0, 0, 4, 5, 1);
  // 255·(0.5 + 0.1) + ½ output LSB; a whole table; 255 LSB.
  EXPECT_EQ(setup.diffuse[0].t0, std::llround(127.5 * 65536) + std::llround(26.0 * 65536));
  EXPECT_EQ(setup.specular.t0, 1024 << 12);
  EXPECT_EQ(setup.gate.t0, 255 << 16);
  for (const FixedQuadratic& t : {setup.diffuse[0], setup.specular, setup.gate}) {
    for (const std::int64_t coefficient : {t.t1, t.t2, t.t3, t.t4, t.t5}) EXPECT_EQ(coefficient, 0);
  }
  // Depth runs from 0 at x = 0 to 2^24 − 1 at x = 32; the centre of pixel 4 is at 4.5.
  expect_rounded(setup.depth.c, 16777215 * 4.5 / 32, 16, "depth");
  expect_rounded(setup.depth.a, 16777215 / 32.0, 16, "depth along x");
  EXPECT_EQ(setup.depth.b, 0);
}

// Corners at the centres of pixels 0 and 8 of line 0, with these normals; so the normal at pixel
// (4, 0) is their mean.
TriangleSetup set_up_between(const Vec3& left, const Vec3& right,
                             SeriesFit fit = SeriesFit::taylor) {
  const Scene scene = lit_scene(64, 64);
  Geometry geometry;
  geometry.materials = {grey_material(0.5, 0.25, 20)};
  geometry.triangles.emplace_back();
  auto& v = geometry.triangles[0].vertices;
  const std::array<std::array<int, 2>, 3> corners = {{{0, 0}, {8, 0}, {0, 8}}};
  for (std::size_t i = 0; i < 3; ++i) {
    v[i].x = corners[i][0] * kSubpixels + kSubpixels / 2;
    v[i].y = corners[i][1] * kSubpixels + kSubpixels / 2;
  }
  v[0].normal = left;
  v[1].normal = right;
  v[2].normal = Vec3(0, 0, 1);
  FrameConfiguration configuration;
  configuration.series_fit = fit;
  const FrameSetup frame(scene, geometry, configuration);
  return SetupEngine(frame).set_up(0, 0, 4, 0, 1);
}

TEST(SetupEngine, ReportsOpposedNormals) {
  EXPECT_FALSE(set_up_between(Vec3(0.6, 0, 0.8), Vec3(-0.6, 0, 0.8)).overflow);
  EXPECT_TRUE(set_up_between(Vec3(1, 0, 0), Vec3(-1, 0, 0)).overflow) << "C = 0: not a number";
  EXPECT_TRUE(set_up_between(Vec3(1, 0, 1e-9), Vec3(-1, 0, 0)).overflow) << "T5 beyond 63 bits";
}

// The sampled fits only need a normal at their points; the middle of this edge has none.
TEST(SetupEngine, ReportsSamplesWithoutANormal) {
  for (const SeriesFit fit : {SeriesFit::six_point, SeriesFit::weighted, SeriesFit::focused}) {
    EXPECT_FALSE(set_up_between(Vec3(1, 0, 1e-3), Vec3(-1, 0, 0), fit).overflow);
    EXPECT_TRUE(set_up_between(Vec3(1, 0, 0), Vec3(-1, 0, 0), fit).overflow);
  }
}

// Every bit of the mantissa less doubles what the coefficients lose, on average; with 52 nothing is
// lost.
TEST(SetupEngine, NarrowerArithmeticLosesWhatItShould) {
  Random random(20261129);
  const Scene scene = lit_scene(64, 64);
  const Geometry geometry = random_geometry(random, scene, 200, 20);
  FrameConfiguration configuration;
  configuration.diffuse_fraction_bits = 30;
  configuration.series_fit = SeriesFit::weighted;
  // Root of the mean square over all diffuse T0, in LSB, of what `mantissa_bits` lose.
  const auto loss = [&](int mantissa_bits) {
    double squares = 0;
    configuration.mantissa_bits = mantissa_bits;
    const FrameSetup narrow(scene, geometry, configuration);
    configuration.mantissa_bits = kDoubleMantissaBits;
    const FrameSetup wide(scene, geometry, configuration);
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
      const std::int64_t a = SetupEngine(narrow).set_up(i, 0, 32, 32, 20).diffuse[0].t0;
      const std::int64_t b = SetupEngine(wide).set_up(i, 0, 32, 32, 20).diffuse[0].t0;
      const double lsb = std::ldexp(static_cast<double>(a - b), -30 - kSetupExtraBits);
      squares += lsb * lsb;
    }
    return std::sqrt(squares / static_cast<double>(geometry.triangles.size()));
  };
  EXPECT_EQ(loss(kDoubleMantissaBits), 0);
  double before = loss(16);
  EXPECT_GT(before, 0);
  for (const int bits : {24, 32, 40}) {
    const double now = loss(bits);
    EXPECT_GT(before / now, 100) << bits << " bits";
    EXPECT_LT(before / now, 700) << bits << " bits";
    before = now;
  }
}

}  // namespace
}  // namespace phongpipe
