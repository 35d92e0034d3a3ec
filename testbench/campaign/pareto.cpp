#include "testbench/campaign/pareto.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace phongpipe {

std::vector<std::size_t> pareto_front(const std::vector<std::optional<ParetoPoint>>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i]) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::make_tuple(points[i]->a, points[i]->b, i) <
           std::make_tuple(points[j]->a, points[j]->b, j);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const ParetoPoint& point = *points[i];
    const bool first = front.empty();
    const ParetoPoint* const last = first ? nullptr : &*points[front.back()];
    if (first || point.b < last->b || (point.b == last->b && point.a == last->a)) {
      front.push_back(i);
    }
  }
  return front;
}

std::string scene_text(const ResultTable& table, std::size_t row) {
  std::string text = table.text(row, "scene");
  for (const std::string& column : table.columns) {
    if (!is_scene_key(column)) continue;
    text += fmt::format(", {}={}", column.substr(kSceneSection.size()), table.text(row, column));
  }
  return text;
}

std::vector<std::vector<std::size_t>> fronts_by_scene(const ResultTable& table) {
  std::map<std::string, std::size_t> scene_of;
  std::vector<std::vector<std::optional<ParetoPoint>>> points;  // by scene, then by row
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto [scene, added] = scene_of.emplace(table.text(row, "scene_hash"), points.size());
    if (added) points.emplace_back(table.rows.size());
    const auto time = table.number(row, "frame_ns_per_pixel"), error = table.number(row, "max_lsb");
    if (table.text(row, "outcome") == "passed" && time && error) {
      points[scene->second][row] = ParetoPoint{*time, *error};
    }
  }
  std::vector<std::vector<std::size_t>> fronts;
  for (const auto& of_scene : points) {
    std::vector<std::size_t> front = pareto_front(of_scene);
    if (!front.empty()) fronts.push_back(std::move(front));
  }
  return fronts;
}

}  // namespace phongpipe
