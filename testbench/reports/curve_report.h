// Curves as a few lines, as JSON and as CSV.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "testbench/methods/curves.h"

namespace phongpipe {

// What the curve shows, and where each series begins and ends: of many series those that end
// lowest.
std::string curve_text(const Curve& curve);
nlohmann::ordered_json curve_json(const Curve& curve);
// A column x, then a column per series, empty if the series has no point at that x.
std::string curve_csv(const Curve& curve);

}  // namespace phongpipe
