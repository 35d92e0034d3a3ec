// The bit-accurate frame: its only errors are those of rounded coefficients, within the bound of
// NUMERICS section 5, and they are the same whatever evaluates it.
#include "model/fixed/model_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "model/fixed/front_end.h"
#include "testbench/cases/random_frame.h"
#include "testbench/cases/recorded_model.h"

namespace phongpipe {
namespace {

constexpr unsigned kModelFrameSeed = 41;

using Real = long double;

Real value(const Quadratic<double>& t, Real x, Real y) {
  return (t.t5 * x + t.t4 * y + t.t2) * x + (t.t3 * y + t.t1) * y + t.t0;
}

// Units of the register: half of one is ε. Returns the largest share of the bound that is used, and
// fails where it is exceeded. `level` is folded into T0.
Real check_span(const SeriesStart& start, const Quadratic<double>& real, std::int64_t level,
                int fraction_bits, const Span& span, const TriangleSetup& setup, Anchor anchor) {
  Real largest_share = 0;
  std::int64_t v = start.v, d1 = start.d1;
  for (int i = 0; i < span.row.length; ++i, v += d1, d1 += start.d2) {
    const int x = span.row.x + i - setup.x, y = span.row.y - setup.y;
    const Real exact = std::ldexp(value(real, x, y), fraction_bits) + static_cast<Real>(level);
    const Real extent = std::max(std::abs(x), std::abs(y)), n = i;
    const Real of_coefficients = 0.5L * (1 + 2 * extent + 3 * extent * extent);
    const Real bound =
        anchor == Anchor::triangle
            ? of_coefficients
            : 0.5L * (1 + n + n * (n - 1) / 2) + std::ldexp(of_coefficients, -kSetupExtraBits);
    const Real error = std::fabs(static_cast<Real>(v) - exact);
    if (error > bound) {
      ADD_FAILURE() << "pixel " << i << " of " << span.row.length << ", (" << x << ", " << y
                    << ") from the expansion point: off by " << static_cast<double>(error)
                    << " units, bound " << static_cast<double>(bound);
      return 1;
    }
    largest_share = std::max(largest_share, error / bound);
  }
  return largest_share;
}

void expect_drift_within_bound(Anchor anchor) {
  SCOPED_TRACE(kModelFrameSeed);
  Random random(kModelFrameSeed);
  Real largest_share = 0;
  for (const double size : {4.0, 20.0, 100.0}) {
    const Scene scene = lit_scene(300, 300);
    const Geometry geometry = random_geometry(random, scene, 60, size);
    FrameConfiguration configuration;
    configuration.anchor = anchor;
    configuration.diffuse_fraction_bits = random.integer(8, 24);
    configuration.specular_fraction_bits = random.integer(6, 20);
    const FrameSetup frame(scene, geometry, configuration);
    const FrontEnd front_end(frame);
    const SetupEngine engine(frame);
    TriangleWork work;
    for (std::uint32_t i = 0; i < front_end.triangles(); ++i) {
      if (front_end.set_up(i, 0, work) != SetupOutcome::ready) continue;
      const TriangleCoefficients<double> real =
          engine.coefficients(i, 0, work.setup.x, work.setup.y);
      const std::int64_t level = work.setup.material->level[0];
      for (const RowSpan& row : work.rows) {
        const Span span = front_end.span_walker().start(work.setup, row);
        const Real diffuse =
            check_span(span.diffuse[0], real.diffuse[0], level, configuration.diffuse_fraction_bits,
                       span, work.setup, anchor);
        const Real specular =
            check_span(span.specular, real.specular, 0, configuration.specular_fraction_bits, span,
                       work.setup, anchor);
        largest_share = std::max({largest_share, diffuse, specular});
        if (testing::Test::HasFailure()) FAIL() << "triangle " << i << " of size " << size;
      }
    }
  }
  EXPECT_GT(largest_share, 0.5L) << "the cases do not come near the bound";
}

TEST(ModelFrame, DriftIsWithinTheBoundWhereTrianglesAreTheAnchor) {
  expect_drift_within_bound(Anchor::triangle);
}

TEST(ModelFrame, DriftIsWithinTheBoundWhereSpansAreTheAnchor) {
  expect_drift_within_bound(Anchor::span);
}

TEST(ModelFrame, IsTheSameHoweverItIsEvaluated) {
  SCOPED_TRACE(kModelFrameSeed);
  Random random(kModelFrameSeed);
  for (const int channels : {1, 3}) {
    const Scene scene = lit_scene(160, 120);
    const Geometry geometry = random_geometry(random, scene, 80, 25);
    FrameConfiguration configuration;
    configuration.channels = channels;
    const FrameSetup frame(scene, geometry, configuration);
    const RecordedModel stepping = record_model(frame, Evaluation::stepping);
    for (const Evaluation evaluation : {Evaluation::portable, best_evaluation()}) {
      const RecordedModel other = record_model(frame, evaluation);
      EXPECT_EQ(other.stream.size(), stepping.stream.size());
      EXPECT_TRUE(other.stream == stepping.stream);
      EXPECT_EQ(other.colors(), stepping.colors());
      EXPECT_EQ(other.triangles.set_up, stepping.triangles.set_up);
      EXPECT_EQ(other.triangles.overflows, stepping.triangles.overflows);
    }
  }
}

// A triangle's pixels do not depend on what was shaded before it: the right table is loaded.
TEST(ModelFrame, TwoMaterialsAreShadedAsEachAlone) {
  SCOPED_TRACE(kModelFrameSeed);
  Random random(kModelFrameSeed);
  const Scene scene = lit_scene(160, 120);
  const Geometry geometry = random_geometry(random, scene, 40, 25);
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  const RecordedModel together = record_model(frame);
  std::vector<ShadedPixel> one_by_one;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    Geometry alone = geometry;
    alone.triangles = {triangle};
    const RecordedModel part = record_model(FrameSetup(scene, alone, FrameConfiguration()));
    one_by_one.insert(one_by_one.end(), part.stream.begin(), part.stream.end());
  }
  EXPECT_TRUE(together.stream == one_by_one);
}

TEST(ModelFrame, StreamSpansAndFramebufferTellTheSame) {
  SCOPED_TRACE(kModelFrameSeed);
  Random random(kModelFrameSeed);
  const Scene scene = lit_scene(160, 120);
  Geometry geometry = random_geometry(random, scene, 40, 25);
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  const std::size_t all = run_model(frame).triangles.set_up;
  for (ScreenVertex& vertex : geometry.triangles[7].vertices) vertex.x += 1000 * kSubpixels;
  const RecordedModel model = record_model(frame);
  EXPECT_EQ(model.triangles.set_up, all - 1) << "one lies outside now";
  std::size_t place = 0;
  std::vector<std::uint32_t> triangle_of;  // for each pixel of the stream
  for (const RecordedSpan& span : model.spans) {
    EXPECT_NE(span.triangle, 7U);
    for (int i = 0; i < span.row.length; ++i, ++place) {
      ASSERT_LT(place, model.stream.size());
      EXPECT_EQ(model.stream[place].x, span.row.x + i);
      EXPECT_EQ(model.stream[place].y, span.row.y);
      triangle_of.push_back(span.triangle);
    }
  }
  EXPECT_EQ(place, model.stream.size());
  // Each pixel seen is one of the stream, that of the triangle that owns it.
  std::vector<int> owners(model.framebuffer.size());
  for (std::size_t k = 0; k < model.stream.size(); ++k) {
    const ShadedPixel& pixel = model.stream[k];
    const std::size_t index = pixel.y * 160U + pixel.x;
    EXPECT_TRUE(model.framebuffer.covered(index));
    if (!model.framebuffer.owned(index, triangle_of[k])) continue;
    ++owners[index];
    EXPECT_EQ(pixel.color, model.framebuffer.color(index));
  }
  std::size_t visible = 0;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    EXPECT_EQ(owners[i], model.framebuffer.covered(i) ? 1 : 0) << "index " << i;
    if (owners[i] == 0) {
      EXPECT_EQ(model.framebuffer.color(i), 0U) << "the background";
    }
    visible += static_cast<std::size_t>(owners[i]);
  }
  EXPECT_GT(visible, 1000U);
  EXPECT_LT(visible, model.stream.size()) << "nothing overlaps";
}

TEST(ModelFrame, CountsTrianglesWhoseValuesLeaveTheirRegisters) {
  SCOPED_TRACE(kModelFrameSeed);
  Random random(kModelFrameSeed);
  const Scene scene = lit_scene(160, 120);
  Geometry geometry = random_geometry(random, scene, 10, 25);
  const FrameSetup frame(scene, geometry, FrameConfiguration());
  EXPECT_EQ(run_model(frame).triangles.overflows, 0U);
  auto& vertices = geometry.triangles[3].vertices;
  vertices[0].normal = Vec3(1, 0, 0.01);
  vertices[1].normal = Vec3(-1, 0, 0.01);
  vertices[2].normal = Vec3(0, 0, 0.01);
  EXPECT_EQ(run_model(frame).triangles.overflows, 1U);
}

}  // namespace
}  // namespace phongpipe
