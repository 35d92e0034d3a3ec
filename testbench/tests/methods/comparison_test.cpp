// The comparison of shading methods: time from operations, break-even sizes, errors, refusals.
#include "testbench/methods/comparison.h"

#include <gtest/gtest.h>

#include "model/files/scene_file.h"
#include "model/files/text_file.h"
#include "testbench/methods/curves.h"
#include "testbench/methods/operation_time.h"
#include "testbench/reports/comparison_report.h"
#include "testbench/tests/methods/result_of.h"
#include "testbench/tests/occurrences.h"

namespace phongpipe {
namespace {

Comparison compare_scene(const std::string& name) {
  return compare(load_scene(std::string(PHONGPIPE_SCENES) + "/" + name + ".toml"),
                 load_hardware("paper-1k", {}), [](const std::string&) {});
}

TEST(OperationTime, TheBusiestKindOfUnitDecides) {
  PipelineConfiguration units;
  units.adders = {2, 2, 1};
  units.multipliers = {1, 3, 1};
  units.rsqrt = {1, 10, 4};
  EXPECT_EQ(clocks({6, 2, 0, 0, 0, 0}, units), 3);  // additions on two adders
  EXPECT_EQ(clocks({2, 6, 0, 0, 0, 0}, units), 6);
  EXPECT_EQ(clocks({0, 0, 2, 0, 0, 0}, units), 8);  // each keeps the unit for four clocks
  EXPECT_EQ(clocks({1, 0, 0, 0, 0, 5}, units), 5);  // one memory port
}

TEST(OperationTime, ThereIsNoDividerAndNoRoot) {
  PipelineConfiguration units;
  units.multipliers = {1, 1, 1};
  units.rsqrt = {1, 1, 1};
  EXPECT_EQ(clocks({0, 0, 0, 1, 1, 0}, units), 1);  // x/√y: one 1/√, one multiplication
  EXPECT_EQ(clocks({0, 0, 0, 1, 0, 0}, units), 2);  // x/y: one 1/√, two multiplications
  EXPECT_EQ(clocks({0, 0, 0, 3, 1, 0}, units), 5);
}

TEST(OperationTime, ThePapersSequentialMachine) {
  EXPECT_EQ(sequential_operations({5, 0, 0, 0, 0, 1}), 6);   // Taylor, full
  EXPECT_EQ(sequential_operations({3, 0, 0, 1, 1, 0}), 14);  // Duff, diffuse
  EXPECT_EQ(sequential_operations({7, 6, 0, 1, 1, 0}), 24);  // Phong, diffuse
  EXPECT_EQ(sequential_operations({0, 0, 2, 0, 0, 0}), 20);
}

// Bishop & Weimer: "offset … for polygons with 10 or more pixels", with 1/√ as 10 operations.
TEST(BreakEven, TaylorOverDuffAndPhongIsWithinThePapersTenPixels) {
  const auto costs = [](const char* name) {
    return find_shading_method(name)->costs(Parts::diffuse, PowerKind::table);
  };
  for (const char* other : {"duff", "phong"}) {
    const auto pixels = break_even_pixels(costs("taylor"), costs(other), sequential_operations);
    ASSERT_TRUE(pixels.has_value()) << other;
    EXPECT_GT(*pixels, 1) << other;
    EXPECT_LE(*pixels, 10) << other;
  }
}

TEST(Comparison, ExactMethodsEqualPhongAndApproximationsRankAsTheyShould) {
  const Comparison c = compare_scene("sphere");
  EXPECT_LT(result_of(c, "phong").error.largest_lsb, 1e-9);
  EXPECT_LT(result_of(c, "duff").error.largest_lsb, 1e-8);
  EXPECT_LT(result_of(c, "phong").largest_seam_lsb, 1e-9);
  const double taylor = result_of(c, "taylor").error.largest_lsb;
  const double gouraud = result_of(c, "gouraud").error.largest_lsb;
  EXPECT_LT(taylor, 0.2);
  EXPECT_GT(gouraud, 5 * taylor);
  EXPECT_GT(result_of(c, "flat").error.largest_lsb, gouraud);
  EXPECT_LT(result_of(c, "gouraud").clocks_per_pixel, result_of(c, "phong").clocks_per_pixel);
}

TEST(Comparison, FittedQuadraticsBeatTheTaylorSeriesAtEqualCostAPixel) {
  const Comparison c = compare_scene("teapot");
  const MethodResult& taylor = result_of(c, "taylor");
  for (const char* name : {"six-point", "weighted", "focused"}) {
    const MethodResult& fitted = result_of(c, name);
    EXPECT_EQ(fitted.costs.pixel, taylor.costs.pixel) << name;
    EXPECT_LT(fitted.error.largest_lsb, 0.5 * taylor.error.largest_lsb) << name;
  }
}

TEST(Comparison, RefusesByNameAndSaysWhy) {
  const Comparison c = compare_scene("torus");  // a local viewer
  EXPECT_NE(result_of(c, "spot-reflection").refused, "");
  EXPECT_NE(result_of(c, "otm").refused, "");
  EXPECT_NE(result_of(c, "taylor").refused, "");
  EXPECT_EQ(result_of(c, "taylor-local").refused, "");
  const std::string text = comparison_text(c);
  for (const ShadingMethod& method : shading_methods()) {
    EXPECT_NE(text.find("\n" + std::string(method.name)), std::string::npos) << method.name;
  }
  EXPECT_NE(text.find("refused: "), std::string::npos);
}

// A limit has neither cost nor time, and holds for whatever scene.
TEST(Comparison, TheLimitOfQuadraticsIsLastAndNeverRefused) {
  for (const char* scene : {"sphere", "torus"}) {
    const Comparison c = compare_scene(scene);
    const MethodResult& best = c.methods.back();
    EXPECT_EQ(best.name, "best");
    EXPECT_TRUE(best.is_limit);
    EXPECT_EQ(best.refused, "");
    EXPECT_LE(best.error.largest_lsb, 1.02 * result_of(c, "focused-local").error.largest_lsb);
    EXPECT_NE(comparison_text(c).find("best                            –"), std::string::npos);
    const auto json = comparison_json(c)["methods"].back();
    EXPECT_TRUE(json.contains("max_lsb"));
    EXPECT_FALSE(json.contains("clocks_per_pixel"));
    EXPECT_NE(comparison_csv(c).find(",best,,,,,,,,,,"), std::string::npos);
  }
}

TEST(Comparison, LargestErrorsAreGivenAsMultiplesOfTaylors) {
  const auto methods = comparison_json(compare_scene("torus"))["methods"];
  for (const auto& method : methods) {
    if (method["method"] == "taylor-local") {
      EXPECT_EQ(method["max_over_taylor"], 1);
    } else if (method["method"] == "weighted-local") {
      EXPECT_LT(method["max_over_taylor"], 0.5);
    }
  }
}

TEST(Comparison, MethodsOfTheOtherHighlightAreComparedWithTheirOwnPhong) {
  const Comparison c = compare_scene("sphere");
  const MethodResult& result = result_of(c, "duff-eq17");
  EXPECT_NE(result.note.find("R·V"), std::string::npos);
  EXPECT_LT(result.error.largest_lsb, 1e-6);
}

// Rounding of doubles makes no method better than another: of those that equal exact Phong only the
// cheapest is on the front, and all have the error 0.
TEST(Comparison, MethodsOfTheSameErrorDoNotShareAFront) {
  const Comparison c = compare_scene("sphere");
  double cheapest_ns = result_of(c, "phong").ns_per_pixel;
  for (const char* name : {"duff", "duff-blinn", "duff-eq17", "duff-eq33", "duff-eq34"}) {
    ASSERT_LT(result_of(c, name).error.largest_lsb, 1e-6) << name;
    cheapest_ns = std::min(cheapest_ns, result_of(c, name).ns_per_pixel);
  }
  const std::vector<PlotPoint> front = accuracy_against_time(c).series.back().points;
  EXPECT_EQ(front.back().x, cheapest_ns);
  EXPECT_GT(front[front.size() - 2].y, front.back().y);
  EXPECT_EQ(occurrences(comparison_csv(c), "e-"), 0U) << comparison_csv(c);
}

TEST(Comparison, CsvHasARowAMethodAndEqualColumns) {
  const Comparison c = compare_scene("sphere");
  const std::string csv = comparison_csv(c);
  LineReader reader(csv);
  std::string_view line;
  ASSERT_TRUE(reader.next(line));
  const auto columns = std::count(line.begin(), line.end(), ',');
  std::size_t rows = 0;
  while (reader.next(line)) {
    std::string outside_quotes;
    bool quoted = false;
    for (const char character : line) {
      if (character == '"') quoted = !quoted;
      if (!quoted) outside_quotes += character;
    }
    EXPECT_EQ(std::count(outside_quotes.begin(), outside_quotes.end(), ','), columns) << line;
    ++rows;
  }
  EXPECT_EQ(rows, c.methods.size());
}

TEST(Microvax, TheCountedTableRanksAsThePrintedOne) {
  const std::string text = microvax_text();
  for (const char* name : {"Gouraud", "Taylor (infinite)", "Taylor (finite)", "Duff", "Phong"}) {
    EXPECT_NE(text.find(name), std::string::npos);
  }
  EXPECT_NE(text.find("119"), std::string::npos);
}

}  // namespace
}  // namespace phongpipe
