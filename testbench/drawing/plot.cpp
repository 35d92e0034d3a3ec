#include "testbench/drawing/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string_view>

#include "testbench/drawing/plot_axis.h"
#include "testbench/drawing/plot_labels.h"
#include "testbench/system/markup.h"

namespace phongpipe {
namespace {

constexpr double kLeft = 76, kTop = 44, kPlotWidth = 640, kPlotHeight = 440, kBottom = 60;
constexpr double kRight = 24, kLegendRow = 17, kLegendSample = 44;

constexpr std::array<const char*, 10> kColors = {"#1f5fa8", "#d1580b", "#1b7f3b", "#c21f2f",
                                                 "#7a4bb0", "#8a5a2b", "#cf4fa0", "#555555",
                                                 "#8c8a00", "#0d93a8"};
// Not as many as colours, so that of two lines in the same place the lower shows through the gaps.
constexpr std::array<const char*, 4> kDashes = {"", "7 3", "2 3", "9 3 2 3"};
// Paths about (0, 0).
constexpr std::array<const char*, 7> kMarkers = {"M-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0 -7 0z",
                                                 "M-3 -3h6v6h-6z",
                                                 "M0 -4L4 3H-4z",
                                                 "M0 -4.5L4 0L0 4.5L-4 0z",
                                                 "M0 4L4 -3H-4z",
                                                 "M-3 -3L3 3M-3 3L3 -3",
                                                 "M-4 0H4M0 -4V4"};

template <double PlotPoint::*kCoordinate>
PlotAxis axis_of(const Chart& chart) {
  constexpr bool kX = kCoordinate == &PlotPoint::x;
  const bool logarithmic = kX ? chart.log_x : chart.log_y;
  std::vector<double> values;
  for (const PlotSeries& series : chart.series) {
    for (const PlotPoint& point : series.points) {
      if (usable(point.x, chart.log_x) && usable(point.y, chart.log_y)) {
        values.push_back(point.*kCoordinate);
      }
    }
  }
  if (values.empty()) return PlotAxis(logarithmic ? 1 : 0, logarithmic ? 10 : 1, logarithmic);
  std::sort(values.begin(), values.end());
  auto low = values.begin();
  while (logarithmic && *low < values.back() * std::pow(10, -kMostDecades)) ++low;
  return PlotAxis(*low, values.back(), logarithmic);
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart)
      : chart_(chart),
        x_(axis_of<&PlotPoint::x>(chart)),
        y_(axis_of<&PlotPoint::y>(chart)),
        labels_({kLeft, kTop, kLeft + kPlotWidth, kTop + kPlotHeight}) {}

  std::string text() {
    double legend = 0;
    if (has_legend()) {
      for (const PlotSeries& s : chart_.series) legend = std::max(legend, text_width(entry(s)));
      legend += kLegendSample;
    }
    const double rows = has_legend() ? static_cast<double>(chart_.series.size()) * kLegendRow : 0;
    const double width = kLeft + kPlotWidth + kRight + legend;
    const double height = kTop + std::max(kPlotHeight + kBottom, rows + kLegendRow);
    add(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" )"
        R"(viewBox="0 0 {0:.0f} {1:.0f}" font-family="sans-serif" font-size="11" fill="#222">)"
        "\n<title>{2}</title>\n"
        R"(<rect width="100%" height="100%" fill="white"/>)"
        "\n",
        width, height, markup_text(chart_.title));
    add_axes();
    for (std::size_t i = 0; i < chart_.series.size(); ++i) add_series(i);
    add_labels();
    if (has_legend()) add_legend();
    return out_ + "</svg>\n";
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  void add_text(double x, double y, std::string_view style, const std::string& text) {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, markup_text(text));
  }
  void add_line(double x0, double y0, double x1, double y1, const char* color) {
    add("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", x0, y0, x1, y1, color);
  }

  bool has_legend() const { return chart_.series.size() > 1; }
  double across(double x) const { return kLeft + kPlotWidth * x_.place(x); }
  double down(double y) const { return kTop + kPlotHeight * (1 - y_.place(y)); }
  bool drawn(const PlotPoint& p) const {
    return usable(p.x, chart_.log_x) && usable(p.y, chart_.log_y) && !x_.below(p.x) &&
           !y_.below(p.y);
  }

  void add_axes() {
    const double bottom = kTop + kPlotHeight, right = kLeft + kPlotWidth;
    for (const double x : x_.minor_ticks()) add_line(across(x), kTop, across(x), bottom, "#f0f0f0");
    for (const double y : y_.minor_ticks()) add_line(kLeft, down(y), right, down(y), "#f0f0f0");
    for (const double x : x_.ticks()) {
      add_line(across(x), kTop, across(x), bottom + 4, "#c8c8c8");
      add_text(across(x), bottom + 17, "text-anchor=\"middle\"", x_.label(x));
    }
    for (const double y : y_.ticks()) {
      add_line(kLeft - 4, down(y), right, down(y), "#c8c8c8");
      add_text(kLeft - 8, down(y) + 4, "text-anchor=\"end\"", y_.label(y));
    }
    add("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\"/>\n",
        kLeft, kTop, kPlotWidth, kPlotHeight);
    add_text(kLeft, kTop - 18, "font-size=\"15\" font-weight=\"bold\"", chart_.title);
    add_text(kLeft + kPlotWidth / 2, bottom + 42, "font-size=\"13\" text-anchor=\"middle\"",
             chart_.x_label);
    add("<g transform=\"translate(20 {:.1f}) rotate(-90)\">\n", kTop + kPlotHeight / 2);
    add_text(0, 0, "font-size=\"13\" text-anchor=\"middle\"", chart_.y_label);
    out_ += "</g>\n";
  }

  // Hovering over a line or a point shows the series' name.
  void begin_series(std::size_t i) {
    const char* const color = kColors[i % kColors.size()];
    add("<g stroke=\"{}\" fill=\"{}\" stroke-width=\"1.6\">\n<title>{}</title>\n", color, color,
        markup_text(chart_.series[i].name));
  }
  void add_path(std::size_t i, const std::string& path) {
    if (path.empty()) return;
    add("<path d=\"{}\" fill=\"none\" stroke-dasharray=\"{}\"/>\n", path,
        *kDashes[i % kDashes.size()] == '\0' ? "none" : kDashes[i % kDashes.size()]);
  }
  void add_marker(std::size_t i, double x, double y) {
    add("<path d=\"{}\" transform=\"translate({:.1f} {:.1f})\"/>\n", kMarkers[i % kMarkers.size()],
        x, y);
  }

  bool has_line(std::size_t i) const { return chart_.lines && chart_.series[i].joined; }
  // Of many lines, one marks every third point, so that two in the same place show different marks.
  bool marked(std::size_t i, std::size_t k) const {
    constexpr std::size_t kMany = 6, kEvery = 3;
    const auto& points = chart_.series[i].points;
    if (!has_line(i) || chart_.series.size() <= kMany || i % kEvery == k % kEvery) return true;
    const bool joined =
        (k > 0 && drawn(points[k - 1])) || (k + 1 < points.size() && drawn(points[k + 1]));
    return !joined || !points[k].label.empty();
  }

  void add_series(std::size_t i) {
    begin_series(i);
    std::string path;
    const PlotPoint* last = nullptr;  // that is joined
    for (const PlotPoint& point : chart_.series[i].points) {
      const bool shown = drawn(point);
      if (shown) {
        const double x = across(point.x), y = down(point.y);
        path += fmt::format("{}{:.1f} {:.1f}", last != nullptr ? "L" : "M", x, y);
        if (last != nullptr && has_line(i))
          labels_.avoid_line(across(last->x), down(last->y), x, y);
      }
      last = shown ? &point : nullptr;
    }
    if (has_line(i)) add_path(i, path);
    const auto& points = chart_.series[i].points;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!drawn(points[k]) || !marked(i, k)) continue;
      add_marker(i, across(points[k].x), down(points[k].y));
      labels_.avoid(across(points[k].x), down(points[k].y));
    }
    out_ += "</g>\n";
  }

  // Set against the side of the box that is next to the point: widths are estimates.
  static std::string label_style(const Box& box, double x) {
    const char* const anchor = x <= box.left ? "start" : x >= box.right ? "end" : "middle";
    return fmt::format(R"(text-anchor="{}" stroke="white" stroke-width="2" paint-order="stroke")",
                       anchor);
  }

  // After all points, which they keep clear of; those on the right first, since right of a point is
  // the first choice. A label pushed away is tied to its point.
  void add_labels() {
    std::vector<const PlotPoint*> points;
    for (const PlotSeries& series : chart_.series) {
      for (const PlotPoint& point : series.points) {
        if (!point.label.empty() && drawn(point)) points.push_back(&point);
      }
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const PlotPoint* a, const PlotPoint* b) { return a->x > b->x; });
    for (const PlotPoint* const point : points) {
      const double x = across(point->x), y = down(point->y);
      const Box box = labels_.place(x, y, text_width(point->label));
      const double near_x = std::clamp(x, box.left, box.right);
      const double near_y = std::clamp(y, box.top, box.bottom);
      constexpr double kApart = 13;
      if (std::hypot(near_x - x, near_y - y) > kApart) add_line(x, y, near_x, near_y, "#999");
      add_text(near_x, box.bottom - 2, label_style(box, x), point->label);
    }
  }

  std::string entry(const PlotSeries& series) const {
    const auto& points = series.points;
    const auto is_drawn = [this](const PlotPoint& p) { return drawn(p); };
    if (std::any_of(points.begin(), points.end(), is_drawn)) return series.name;
    const bool low = std::all_of(points.begin(), points.end(),
                                 [this](const PlotPoint& p) { return y_.below(p.y); });
    return series.name + (low && !points.empty() ? " (below the axis)" : " (not shown)");
  }

  void add_legend() {
    const double x = kLeft + kPlotWidth + kRight / 2;
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const double y = kTop + kLegendRow * (static_cast<double>(i) + 0.5);
      begin_series(i);
      if (has_line(i)) add_path(i, fmt::format("M{:.1f} {:.1f}h32", x, y));
      add_marker(i, x + 16, y);
      out_ += "</g>\n";
      add_text(x + 40, y + 4, "", entry(chart_.series[i]));
    }
  }

  const Chart& chart_;
  PlotAxis x_, y_;
  Labels labels_;
  std::string out_;
};

}  // namespace

std::string svg(const Chart& chart) {
  return Drawing(chart).text();
}

}  // namespace phongpipe
