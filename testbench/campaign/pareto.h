// The Pareto front of points by two measures, both the better the smaller they are.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "testbench/campaign/store.h"

namespace phongpipe {

struct ParetoPoint {
  double a = 0, b = 0;
};

// The indices of the points that no other point beats: none is at most as large in both measures
// and smaller in one. Equal points stand on the front together. Points without a value are never on
// it. Sorted by a, then by index.
std::vector<std::size_t> pareto_front(const std::vector<std::optional<ParetoPoint>>& points);

// The rows of a table that passed and stand on the front of frame_ns_per_pixel against max_lsb.
// Only runs of the same scene, of the same content as far as it varies, compete: each scene has a
// front of its own, in the order of the table.
std::vector<std::vector<std::size_t>> fronts_by_scene(const ResultTable& table);

// Names the scene of a row, with what of it varies: "sphere, material.grey.shininess=20".
std::string scene_text(const ResultTable& table, std::size_t row);

}  // namespace phongpipe
