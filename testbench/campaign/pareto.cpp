#include "testbench/campaign/pareto.h"

#include <algorithm>
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

std::vector<std::size_t> front_of(const ResultTable& table) {
  std::vector<std::optional<ParetoPoint>> points(table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto time = table.number(row, "frame_ns_per_pixel"), error = table.number(row, "max_lsb");
    if (table.text(row, "outcome") == "passed" && time && error) {
      points[row] = ParetoPoint{*time, *error};
    }
  }
  return pareto_front(points);
}

}  // namespace phongpipe
