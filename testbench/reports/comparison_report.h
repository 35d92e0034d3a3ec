// A comparison of methods as a table, as JSON and CSV, and as a page with pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testbench/drawing/plot.h"
#include "testbench/methods/comparison.h"

namespace phongpipe {

// What came out, a line each: how many methods render the scene, the methods to choose from, what
// the hardware's own method does.
std::vector<std::string> comparison_answer(const Comparison& comparison);
// All methods in a table.
std::string comparison_text(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);
std::string comparison_csv(const Comparison& comparison);

// Largest error against time, one point per method.
Chart accuracy_against_time(const Comparison& comparison);

// Writes SCENE-methods.html into the folder, a page with each method's picture and error map, and
// beside it the same pictures and the charts as files. Returns the page and the charts. `render`:
// the command that renders the scene, without a method.
std::vector<std::filesystem::path> write_comparison_page(const Comparison& comparison,
                                                         const std::string& render,
                                                         const std::filesystem::path& folder);

// Bishop & Weimer's timings on a MicroVAX-II beside times from operation counts. The time of an
// operation is the one that makes the setup of their Taylor series take the printed seconds.
std::string microvax_text();

}  // namespace phongpipe
