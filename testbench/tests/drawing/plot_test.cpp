// Charts as SVG text: well formed, complete, and of any numbers.
#include "testbench/drawing/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "testbench/drawing/plot_axis.h"
#include "testbench/drawing/plot_labels.h"
#include "testbench/tests/occurrences.h"

namespace phongpipe {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The first fault of XML without comments and processing instructions; empty if there is none.
std::string fault(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '&') {
      const std::string entity = text.substr(i, text.find(';', i) - i + 1);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;") {
        return "entity " + entity;
      }
    }
    if (text[i] == '>') return "a bare >";
    if (text[i] != '<') continue;
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = text.substr(i + 1, end - i - 1);
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return "quotes in " + tag;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "unexpected " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
    i = end;
  }
  return open.empty() ? "" : "open " + open.back();
}

void expect_sound(const std::string& text) {
  EXPECT_EQ(fault(text), "") << text;
  EXPECT_EQ(text.rfind("<svg ", 0), 0U);
  EXPECT_EQ(occurrences(text, "nan"), 0U) << text;
  EXPECT_EQ(occurrences(text, "inf"), 0U) << text;
}

Chart twenty_lines() {
  Chart chart = {"Title", "across", "up", false, true, true, {}};
  for (int i = 0; i < 20; ++i) {
    PlotSeries series = {"line " + std::to_string(i) + ".", {}};
    for (int x = 0; x < 10; ++x) series.points.push_back({1.0 * x, std::exp(x + 0.1 * i), ""});
    chart.series.push_back(series);
  }
  return chart;
}

TEST(Plot, NamesEverySeriesAndItsAxes) {
  const Chart chart = twenty_lines();
  const std::string text = svg(chart);
  expect_sound(text);
  for (const PlotSeries& series : chart.series) {
    EXPECT_EQ(occurrences(text, ">" + series.name + "</text>"), 1U) << series.name;
  }
  for (const char* part : {">Title</text>", ">across</text>", ">up</text>"}) {
    EXPECT_EQ(occurrences(text, part), 1U) << part;
  }
}

TEST(Plot, OneSeriesNeedsNoLegend) {
  Chart chart = twenty_lines();
  chart.series.resize(1);
  EXPECT_EQ(occurrences(svg(chart), ">line 0.</text>"), 0U);
}

TEST(Plot, EscapesText) {
  Chart chart = twenty_lines();
  chart.title = "a < b & \"c\" > d\x01";
  chart.series[0].name = "<script>";
  chart.series[1].points[0].label = "R·V & <b>";
  const std::string text = svg(chart);
  expect_sound(text);
  EXPECT_EQ(occurrences(text, ">a &lt; b &amp; &quot;c&quot; &gt; d</text>"), 1U);
  EXPECT_EQ(occurrences(text, ">R·V &amp; &lt;b&gt;</text>"), 1U);
  EXPECT_EQ(occurrences(text, "<script"), 0U);
}

TEST(Plot, LeavesOutWhatAxesCannotShow) {
  Chart chart = {"", "", "", true, true, true, {}};
  chart.series.push_back({"good", {{1, 1, ""}, {10, 50, ""}, {20, 0, "gone"}, {30, 70, ""}}});
  chart.series.push_back({"zero", {{1, 0, ""}, {10, -1, ""}, {20, 1e-13, ""}}});
  chart.series.push_back({"wild", {{kInfinity, 1, ""}, {10, std::nan(""), ""}, {0, 1, ""}}});
  const std::string text = svg(chart);
  expect_sound(text);
  EXPECT_EQ(occurrences(text, ">good</text>"), 1U);
  EXPECT_EQ(occurrences(text, ">zero (below the axis)</text>"), 1U);
  EXPECT_EQ(occurrences(text, ">wild (not shown)</text>"), 1U);
  EXPECT_EQ(occurrences(text, "gone"), 0U);
  EXPECT_EQ(occurrences(text, ">1e-"), 0U) << "what is not shown must not stretch the axis";
}

TEST(Plot, OfNothingOrOneValue) {
  expect_sound(svg({}));
  for (const bool logarithmic : {false, true}) {
    Chart chart = {"", "", "", logarithmic, logarithmic, false, {{"one", {{3, 3, "here"}}}}};
    expect_sound(svg(chart));
    chart.series[0].points[0] = {0, 0, ""};
    expect_sound(svg(chart));
    chart.series[0].points[0] = {1e299, -1e299, ""};
    expect_sound(svg(chart));
  }
}

TEST(Plot, LinesAreJoinedOnlyWhereAsked) {
  Chart chart = twenty_lines();
  EXPECT_GT(occurrences(svg(chart), "stroke-dasharray"), 20U);
  chart.lines = false;
  EXPECT_EQ(occurrences(svg(chart), "stroke-dasharray"), 0U);
}

TEST(PlotAxis, LogarithmicTicksAreDecades) {
  EXPECT_EQ(axis_ticks(1, 10000, true), (std::vector<double>{1, 10, 100, 1000, 10000}));
  EXPECT_EQ(axis_ticks(0.3, 120, true), (std::vector<double>{0.1, 1, 10, 100, 1000}));
  EXPECT_EQ(axis_ticks(5, 5, true), (std::vector<double>{1, 2, 5, 10}));
  EXPECT_EQ(axis_ticks(10, 10, true), (std::vector<double>{10, 20, 50, 100}));
  const std::vector<double> capped = axis_ticks(1e-13, 90, true);
  EXPECT_EQ(capped.size(), 1U + kMostDecades);
  EXPECT_EQ(capped.back(), 100);
}

TEST(PlotAxis, LinearTicksAreRoundAndCoverTheRange) {
  EXPECT_EQ(axis_ticks(5, 90, false), (std::vector<double>{0, 20, 40, 60, 80, 100}));
  EXPECT_EQ(axis_ticks(-1, 1, false), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  for (const double low : {-1e6, -3.0, 0.0, 0.7, 99.0}) {
    for (const double size : {1e-3, 0.9, 7.0, 1e5}) {
      const std::vector<double> ticks = axis_ticks(low, low + size, false);
      EXPECT_LE(ticks.front(), low);
      EXPECT_GE(ticks.back(), low + size - 1e-9);
      EXPECT_GE(ticks.size(), 3U);
      EXPECT_LE(ticks.size(), 9U) << low << ", " << size;
    }
  }
}

TEST(PlotAxis, LabelsAreShort) {
  EXPECT_EQ(PlotAxis(1e-6, 1e6, true).label(1e-6), "1e-6");
  EXPECT_EQ(PlotAxis(1, 1e4, true).label(1e4), "10000");
  EXPECT_EQ(PlotAxis(1e6, 1e7, true).label(2e6), "2e6");
  EXPECT_EQ(PlotAxis(0, 1, false).label(0.2 + 0.1), "0.3");
}

TEST(Labels, DoNotOverlap) {
  Labels labels({0, 0, 640, 440});
  for (int i = 0; i < 20; ++i) labels.avoid(300 + i, 200);
  std::vector<Box> boxes;
  for (int i = 0; i < 20; ++i) boxes.push_back(labels.place(300 + i, 200, 80));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].meets(boxes[k])) << i << ", " << k;
  }
}

TEST(Labels, StandBesideLines) {
  Labels labels({0, 0, 640, 440});
  labels.avoid(100, 200);
  labels.avoid_line(100, 200, 600, 180);
  const Box box = labels.place(100, 200, 80);
  const auto line = [](double x) { return 200 - (x - 100) * 20 / 500; };
  EXPECT_TRUE(box.right < 100 || box.bottom < line(box.right) || box.top > line(box.left))
      << box.left << ", " << box.top;
}

// The label of a point at the beginning of a line does not lie on it.
TEST(Plot, LinesDoNotStrikeThroughLabels) {
  const auto label_y = [](bool joined) {
    const PlotSeries series = {"a", {{0, 5, "here"}, {9, 5, ""}, {9, 0, ""}, {9, 9, ""}}, joined};
    const Chart chart = {"", "", "", false, false, true, {series}};
    const std::string text = svg(chart);
    const std::string before = text.substr(0, text.find(">here<"));
    return before.substr(before.rfind(" y=\""), 9);
  };
  EXPECT_NE(label_y(true), label_y(false));
}

}  // namespace
}  // namespace phongpipe
