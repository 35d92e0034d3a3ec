// Metrics of a verification. Each is described only here: screen output, JSON and tables are made
// from the descriptions.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "testbench/cosim/verification.h"

namespace phongpipe {

using MetricValue = std::variant<std::monostate, std::int64_t, double>;  // monostate: no value

struct Metric {
  enum class Better { less, more, neither };

  std::string_view name;  // with its unit, as heading of a column
  std::string_view json;  // its place in the report, as a JSON pointer; empty: only in `effects`
  std::string_view unit;  // empty for a count
  Better better;
  std::string_view meaning;
  MetricValue (*value)(const VerificationResult&);
  bool of_blocks = false;  // also compared with hardware that has every effect
};

const std::vector<Metric>& metrics();
// The place of a metric in metrics(). Throws std::out_of_range if there is none of that name.
std::size_t metric_index(std::string_view name);

// The value as a number, if there is one.
std::optional<double> number_of(const MetricValue& value);
// The value for people: whole numbers with separators, others with 4 digits, - for no value.
std::string metric_text(const MetricValue& value);
// Calls `visit` for the metrics of what the hardware consists of, with their values for the scene's
// hardware and for hardware with every effect, if that was simulated.
void for_each_block_metric(const VerificationResult& result,
                           const std::function<void(const Metric&, const MetricValue& own,
                                                    const MetricValue& full)>& visit);
std::string count_text(std::uint64_t count);  // 1,234,567
// The count of things whose plural ends in s: "1 pixel", "1,234,567 pixels".
std::string count_text(std::uint64_t count, std::string_view noun);
// That triangles have values too large for their registers.
std::string overflow_text(std::uint64_t triangles);
// Which pixels differ: "3 of 1,000 pixels, 2 of the final frame". `pixels`: of the stream.
std::string mismatches_text(const ImplementationResult& found, std::uint64_t pixels);

}  // namespace phongpipe
