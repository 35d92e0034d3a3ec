// The plan of a sweep: which settings vary over which values, which are tied to others, and which
// points are left out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "testbench/cosim/run.h"

namespace phongpipe {

// A key, as set_key() takes it, and its values.
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

// `key` is set to the value of an expression, a number, of the axes and of the ties before it.
struct Tie {
  std::string key, expression;
};

struct Plan {
  RunRequest base;  // what does not vary
  std::vector<Axis> axes;
  std::vector<Tie> ties;
  std::vector<std::string> conditions;  // points at which an expression is 0 are left out
  std::uint64_t sample = 0;             // number of points drawn at random; 0: all
  std::uint64_t seed = 1;               // of the sample
};

// One point: its request, and the value of each key that varies or is tied.
struct PlanPoint {
  RunRequest request;
  std::vector<std::pair<std::string, std::string>> values;
};

// The full name of a key: with its section where the key of a setting comes without. Throws
// InputError for a key that nothing has.
std::string full_key(const std::string& key);

// Reads `KEY=LIST|FROM:TO[:STEP]`; items of a list are separated by commas outside brackets, and
// may be ranges. Throws InputError.
Axis parse_axis(const std::string& text);
Tie parse_tie(const std::string& text);  // KEY=EXPRESSION

// Adds the contents of a sweep file to a plan. Keys at the top: scenes, hardware, where, sample,
// seed; tables [set], [vary] and [tie] of key = value.
void read_sweep_file(const std::filesystem::path& file, Plan& plan);

// Number of points of the grid, before conditions; at most 2^63.
std::uint64_t grid_size(const Plan& plan);

// The points of a plan, in the order of the grid: the first axis varies slowest. A sample is drawn
// without repetition. Throws InputError if an expression is wrong, if no point is left, or if there
// are more than kMostPoints.
constexpr std::uint64_t kMostPoints = 100'000;
std::vector<PlanPoint> points_of(const Plan& plan);

}  // namespace phongpipe
