// Curves over curvature, triangle size and exponent: reproducible, and showing what the methods are
// known for.
#include "testbench/methods/curves.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "testbench/cases/named_scene.h"
#include "testbench/methods/operation_time.h"
#include "testbench/methods/specimens.h"
#include "testbench/reports/curve_report.h"

namespace phongpipe {
namespace {

constexpr double kRounding = 1e-8;  // of doubles, in LSB

CurveOptions few() {
  CurveOptions options;
  options.triangles = 15;
  return options;
}

double at(const Curve& curve, const std::string& series, double x) {
  for (const PlotSeries& s : curve.series) {
    if (s.name != series) continue;
    for (const PlotPoint& point : s.points) {
      if (point.x == x) return point.y;
    }
  }
  ADD_FAILURE() << "no " << series << " at " << x;
  return std::nan("");
}

bool has(const Curve& curve, const std::string& series) {
  return std::any_of(curve.series.begin(), curve.series.end(),
                     [&](const PlotSeries& s) { return s.name == series; });
}

// Bishop & Weimer's MicroVAX: 1/√ = 10 additions.
double clocks(const OperationCounts& counts) {
  return static_cast<double>(counts.add + counts.multiply + counts.read) +
         10 * static_cast<double>(counts.rsqrt + counts.divide + counts.sqrt);
}

MethodCosts costs(const char* method, Parts parts) {
  return find_shading_method(method)->costs(parts, PowerKind::table);
}

TEST(Specimens, NormalsSpanTheGivenAngleAndHoldTheHighlight) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  for (const double spread : {5.0, 40.0, 90.0}) {
    for (const Specimen& s : random_specimens({spread, 30, Highlight::halfway}, 20, 7)) {
      const auto& v = s.triangle.vertices;
      const auto angle = [&](std::size_t i, std::size_t k) {
        return std::acos(v[i].normal.dot(v[k].normal)) / kDegree;
      };
      EXPECT_NEAR(std::max({angle(0, 1), angle(1, 2), angle(2, 0)}), spread, 1e-6);
      const Vec3 peak = (v[0].eye - s.scene.lights[0].direction).normalized();
      Eigen::Matrix3d normals;
      normals << v[0].normal, v[1].normal, v[2].normal;
      EXPECT_GT((normals.inverse() * peak).minCoeff(), 0);
      EXPECT_GT(s.pixels, 300U);
    }
  }
}

TEST(Curves, TheSameSeedGivesTheSameNumbers) {
  CurveOptions options = few();
  options.triangles = 5;
  const std::string curvature = curve_csv(curvature_curve(Parts::full, 20, options));
  const std::string exponent = curve_csv(exponent_curve(10, options));
  EXPECT_EQ(curve_csv(curvature_curve(Parts::full, 20, options)), curvature);
  EXPECT_EQ(curve_csv(exponent_curve(10, options)), exponent);
  options.seed = 2;
  EXPECT_NE(curve_csv(curvature_curve(Parts::full, 20, options)), curvature);
  EXPECT_NE(curve_csv(exponent_curve(10, options)), exponent);
}

TEST(Curves, CurvatureDiffuse) {
  const Curve curve = curvature_curve(Parts::diffuse, 20, few());
  for (int spread = 5; spread <= 90; spread += 5) {
    EXPECT_EQ(at(curve, "phong", spread), 0);
    EXPECT_LT(at(curve, "duff", spread), kRounding);
  }
  // NUMERICS section 4, on other triangles: 0.5 at 20 degrees, 18 at 60.
  EXPECT_LT(at(curve, "taylor", 5), 0.02);
  EXPECT_LT(at(curve, "taylor", 20), 1);
  EXPECT_GT(at(curve, "taylor", 60), 10);
  EXPECT_GT(at(curve, "gouraud", 60), at(curve, "taylor", 60));
  EXPECT_GT(at(curve, "taylor", 90), 1.5 * at(curve, "taylor", 60));
  EXPECT_FALSE(has(curve, "spot-reflection")) << "it cannot render a directional light";
}

TEST(Curves, CurvatureFull) {
  const Curve curve = curvature_curve(Parts::full, 20, few());
  EXPECT_EQ(at(curve, "phong", 60), 0);
  EXPECT_GT(at(curve, "taylor", 60), 100 * at(curve, "taylor", 5));
  // At 5 degrees, angle interpolation has already lost the highlight of an eye off the light.
  EXPECT_GT(at(curve, "otm", 5), 40);
  EXPECT_LT(at(curve, "otm-halfway", 5), 10);
  EXPECT_GT(at(curve, "gouraud", 30), 10 * at(curve, "taylor", 30));
  EXPECT_FALSE(has(curve, "duff-eq17")) << "its highlight is R·V";
}

TEST(Curves, CurvatureOfMirrorHighlights) {
  CurveOptions options = few();
  options.highlight = Highlight::reflection;
  const Curve curve = curvature_curve(Parts::full, 20, options);
  EXPECT_LT(at(curve, "duff-eq17", 60), kRounding);
  EXPECT_GT(at(curve, "hybrid", 60), 1);
  EXPECT_FALSE(has(curve, "taylor"));
}

TEST(Curves, ClocksFallWithSize) {
  const Curve curve = size_curve(Parts::full, PowerKind::table, clocks);
  ASSERT_TRUE(has(curve, "taylor"));
  for (const PlotSeries& series : curve.series) {
    EXPECT_EQ(series.points.front().x, 1);
    EXPECT_EQ(series.points.back().x, 10000);
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      EXPECT_LT(series.points[i].y, series.points[i - 1].y) << series.name;
    }
  }
  const MethodCosts taylor = costs("taylor", Parts::full);
  EXPECT_EQ(at(curve, "taylor", 1),
            clocks(taylor.triangle + taylor.span + taylor.pixel + taylor.combine));
  EXPECT_NEAR(at(curve, "taylor", 10000), clocks(taylor.pixel + taylor.combine), 1);
}

TEST(Curves, TaylorBreaksEvenWithinTenPixels) {
  for (const Parts parts : {Parts::diffuse, Parts::full}) {
    for (const char* other : {"phong", "duff"}) {
      const auto size = break_even_pixels(costs("taylor", parts), costs(other, parts), clocks);
      ASSERT_TRUE(size) << other;
      EXPECT_GT(*size, 1) << other;
      EXPECT_LE(*size, 10) << other;
      const auto amortised = [&](const char* method, int pixels) {
        return amortised_clocks(costs(method, parts), pixels, clocks);
      };
      EXPECT_LT(amortised("taylor", *size), amortised(other, *size));
      EXPECT_GE(amortised("taylor", *size - 1), amortised(other, *size - 1));
    }
  }
}

// Both its set-up and its pixels are cheaper, so that there is no size from which Taylor's series
// are; nor is there one between a method and itself.
TEST(Curves, GouraudIsCheaperThanTaylorAtAnySize) {
  for (const Parts parts : {Parts::diffuse, Parts::full}) {
    const MethodCosts gouraud = costs("gouraud", parts), taylor = costs("taylor", parts);
    EXPECT_FALSE(break_even_pixels(taylor, gouraud, clocks));
    EXPECT_EQ(break_even_pixels(gouraud, taylor, clocks), 1);
    EXPECT_FALSE(break_even_pixels(taylor, taylor, clocks));
  }
}

TEST(Curves, BlocksOfThePipeline) {
  const Hardware hardware = load_hardware("default", {"framebuffer.write_cycles=3"});
  const auto scene = std::make_shared<const PreparedScene>(load_named_scene("sphere", {}));
  const Curve curve = block_curve(scene, hardware, 100);
  const double clock_ns = at(curve, "pixel_datapath", 1);
  EXPECT_GT(clock_ns, 1);
  EXPECT_DOUBLE_EQ(at(curve, "pixel_datapath", 10000), clock_ns);
  EXPECT_DOUBLE_EQ(at(curve, "framebuffer", 100), 3 * clock_ns);
  EXPECT_EQ(at(curve, "budget", 7), 100);
  const double taylor = at(curve, "setup_engine, taylor", 1);
  EXPECT_NEAR(at(curve, "setup_engine, taylor", 1000), taylor / 1000, 1e-9);
  EXPECT_GT(taylor, 10 * clock_ns);
  EXPECT_GT(at(curve, "setup_engine, weighted", 1), at(curve, "setup_engine, six-point", 1));
  // A single pixel: two cycles before its row, and one for it.
  EXPECT_NEAR(at(curve, "span_walker", 1), 3 * clock_ns, clock_ns + 1e-9);
}

TEST(Curves, BlocksNeedATriangleToShade) {
  const auto scene = std::make_shared<const PreparedScene>(
      load_named_scene("sphere", {"scene.object.0.translate=[1000,0,0]"}));
  EXPECT_THROW(block_curve(scene, load_hardware("default", {}), 100), InputError);
}

TEST(Curves, BreakEvenIsWhereTheRatioIsOne) {
  const PipelineConfiguration units;
  const Curve curve = break_even_curve(units);
  const auto size = break_even_pixels(costs("taylor", Parts::full), costs("duff", Parts::full),
                                      sequential_operations);
  ASSERT_TRUE(size.has_value());
  const PlotSeries& line =
      *std::find_if(curve.series.begin(), curve.series.end(), [&](const PlotSeries& s) {
        return s.name == fmt::format("taylor over duff, sequential: pays from {} pixels", *size);
      });
  for (const PlotPoint& point : line.points) EXPECT_EQ(point.y < 1, point.x >= *size) << point.x;
  for (const PlotSeries& s : curve.series) EXPECT_LT(s.points.back().y, 1) << s.name;
}

TEST(Curves, Exponent) {
  const Curve curve = exponent_curve(10, few());
  for (const double n : {1, 20, 200, 10000}) EXPECT_EQ(at(curve, "phong", n), 0);
  // NUMERICS section 6: an error of n/(2N), 46 % of full scale with 8k words at n = 10000.
  EXPECT_NEAR(at(curve, "phong, table of 2^10", 20) / 255, 20 / 2048.0, 0.0015);
  EXPECT_NEAR(at(curve, "phong, table of 2^13", 200) / 255, 200 / 16384.0, 0.002);
  EXPECT_GT(at(curve, "phong, table of 2^13", 10000) / 255, 0.40);
  EXPECT_LT(at(curve, "phong, table of 2^13", 10000) / 255, 0.47);
  EXPECT_GT(at(curve, "phong, schlick", 200) / 255, 0.15);
  EXPECT_LT(at(curve, "phong, lyon-16", 10000), at(curve, "phong, lyon-4", 10000));
  EXPECT_GT(at(curve, "taylor", 200), 0.1);
  for (const char* lost : {"gouraud", "otm", "flat"}) {
    EXPECT_GT(at(curve, lost, 10000) / 255, 0.8) << lost << " has no highlight inside";
  }
}

TEST(Curves, TellTheirProgress) {
  CurveOptions options = few();
  options.triangles = 1;
  std::vector<std::string> told;
  options.progress = [&told](const std::string& text) { told.push_back(text); };
  curvature_curve(Parts::diffuse, 20, options);
  ASSERT_EQ(told.size(), 18U);
  EXPECT_EQ(told.front(), "curvature 5 degrees");
}

TEST(Curves, AreChartsOfLines) {
  Curve curve;
  curve.series = {{"a", {}}, {"b", {}}};
  curve.log_y = true;
  curve.title = "t";
  const Chart chart = chart_of(curve);
  EXPECT_TRUE(chart.lines && chart.log_y && !chart.log_x);
  EXPECT_EQ(chart.title, "t");
  EXPECT_EQ(chart.series.size(), 2U);
}

}  // namespace
}  // namespace phongpipe
