// The value of a metric in JSON: null for no value, and in text also for one that is not finite.
#pragma once

#include <nlohmann/json.hpp>

#include "testbench/cosim/metrics.h"

namespace nlohmann {

template <>
struct adl_serializer<phongpipe::MetricValue> {
  template <typename Json>
  static void to_json(Json& j, const phongpipe::MetricValue& value) {
    if (const auto* const whole = std::get_if<std::int64_t>(&value)) {
      j = *whole;
    } else if (const auto* const number = std::get_if<double>(&value)) {
      j = *number;
    } else {
      j = nullptr;
    }
  }
  template <typename Json>
  static void from_json(const Json& j, phongpipe::MetricValue& value) {
    if (j.is_null()) {
      value = std::monostate();
    } else if (j.is_number_integer()) {
      value = j.template get<std::int64_t>();
    } else {
      value = j.template get<double>();
    }
  }
};

}  // namespace nlohmann
