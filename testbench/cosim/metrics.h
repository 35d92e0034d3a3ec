// What a verification measures. Each metric is described here and nowhere else: screen, JSON and
// tables are made from the descriptions.
#pragma once

#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "testbench/cosim/verification.h"

namespace phongpipe {

using MetricValue = std::variant<std::int64_t, double>;

struct Metric {
  enum class Better { less, more, neither };

  std::string_view name;  // with its unit, as a column is called
  std::string_view json;  // where JSON has it, as a JSON pointer; empty: only in `effects`
  std::string_view unit;  // empty for a count
  Better better;
  std::string_view meaning;
  MetricValue (*value)(const VerificationResult&);
  bool of_blocks = false;  // compared with hardware that has every effect
};

const std::vector<Metric>& metrics();

// A number as people read it: with separators, or with decimals.
std::string metric_text(const MetricValue& value);

}  // namespace phongpipe
