#include "testbench/reports/curve_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace phongpipe {

std::string curve_text(const Curve& curve) {
  constexpr std::size_t kFew = 8, kLowest = 3;
  std::vector<PlotSeries> shown = curve.series;
  std::string which;
  if (shown.size() > kFew) {
    std::stable_sort(shown.begin(), shown.end(), [](const PlotSeries& a, const PlotSeries& b) {
      return a.points.back().y < b.points.back().y;
    });
    which = fmt::format("; the lowest of {}", shown.size());
    shown.resize(kLowest);
  }
  std::string text =
      fmt::format("{}\n  {}, over {}{}\n", curve.title, curve.y_label, curve.x_label, which);
  std::size_t width = 0;
  for (const PlotSeries& series : shown) width = std::max(width, series.name.size());
  for (const PlotSeries& series : shown) {
    const PlotPoint &first = series.points.front(), &last = series.points.back();
    text += fmt::format("  {:<{}}  {:.4g} at {:.4g}", series.name, width, first.y, first.x);
    if (series.points.size() > 1) text += fmt::format(" to {:.4g} at {:g}", last.y, last.x);
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json curve_json(const Curve& curve) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const PlotSeries& series : curve.series) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const PlotPoint& point : series.points) points.push_back({point.x, point.y});
    all.push_back({{"name", series.name}, {"points", points}});
  }
  return {{"title", curve.title}, {"x", curve.x_label}, {"y", curve.y_label}, {"series", all}};
}

std::string curve_csv(const Curve& curve) {
  std::map<double, std::vector<std::string>> rows;
  std::string text = "x";
  for (std::size_t i = 0; i < curve.series.size(); ++i) {
    std::string name = curve.series[i].name;
    if (name.find_first_of(",\"\n") != std::string::npos) {
      std::string quoted = "\"";
      for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
      name = quoted + "\"";
    }
    text += "," + name;
    for (const PlotPoint& point : curve.series[i].points) {
      auto& row = rows[point.x];
      row.resize(curve.series.size());
      row[i] = fmt::format("{}", point.y);
    }
  }
  text += "\n";
  for (const auto& [x, row] : rows) {
    text += fmt::format("{}", x);
    for (const std::string& value : row) text += "," + value;
    text += "\n";
  }
  return text;
}

}  // namespace phongpipe
