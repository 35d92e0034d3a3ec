// A comparison of methods as a table, as JSON and CSV, and as a page with pictures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "testbench/drawing/plot.h"
#include "testbench/methods/comparison.h"

namespace phongpipe {

std::string comparison_text(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);
std::string comparison_csv(const Comparison& comparison);

// Largest error against time, a point a method.
Chart accuracy_against_time(const Comparison& comparison);

// Writes SCENE-methods.html into the folder, with the plot in it, and the pictures it shows: each
// method's and its error map.
void write_comparison_page(const Comparison& comparison, const std::filesystem::path& folder);

// Bishop & Weimer's timings on a MicroVAX-II beside what the operations counted say, scaled by one
// factor: the seconds an operation took in setting up their Taylor series.
std::string microvax_text();

}  // namespace phongpipe
