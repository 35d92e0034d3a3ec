// Curves as text, JSON and CSV.
#include "testbench/reports/curve_report.h"

#include <gtest/gtest.h>

namespace phongpipe {
namespace {

TEST(CurveReport, CsvHasAColumnASeries) {
  Curve curve;
  curve.series = {{"a", {{1, 0.5, ""}, {2, 0.25, ""}}}, {"b, \"c\"", {{2, 1e-7, ""}}}};
  EXPECT_EQ(curve_csv(curve), "x,a,\"b, \"\"c\"\"\"\n1,0.5,\n2,0.25,1e-07\n");
}

TEST(CurveReport, TellsWhereEachSeriesBeginsAndEnds) {
  Curve curve;
  curve.title = "Time";
  curve.x_label = "pixels";
  curve.y_label = "clocks";
  curve.series = {{"long", {{1, 20.00001, ""}, {100, 3, ""}, {10000, 1, ""}}}, {"b", {{7, 5, ""}}}};
  EXPECT_EQ(curve_text(curve),
            "Time\n  clocks, over pixels\n"
            "  long  20 at 1 to 1 at 10000\n"
            "  b     5 at 7\n");
  for (int i = 0; i < 9; ++i) curve.series.push_back({"c", {{1, 9.0 - i, ""}}});
  EXPECT_EQ(curve_text(curve),
            "Time\n  clocks, over pixels; the lowest of 11\n"
            "  long  20 at 1 to 1 at 10000\n"
            "  c     1 at 1\n"
            "  c     2 at 1\n");
}

TEST(CurveReport, JsonHasAllPoints) {
  Curve curve;
  curve.title = "Time";
  curve.series = {{"a", {{1, 0.5, ""}, {2, 1e-7, ""}}}};
  EXPECT_EQ(curve_json(curve), nlohmann::ordered_json::parse(
                                   R"({"title": "Time", "x": "", "y": "",
                                       "series": [{"name": "a", "points": [[1, 0.5], [2, 1e-7]]}]})"));
}

}  // namespace
}  // namespace phongpipe
