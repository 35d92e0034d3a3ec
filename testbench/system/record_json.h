// Conversion of records with fields() to and from JSON, for pipes between processes and for result
// files.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "model/shading/fields.h"

namespace nlohmann {

template <typename T>
struct adl_serializer<std::optional<T>> {
  static void to_json(json& j, const std::optional<T>& value) {
    j = value ? json(*value) : json(nullptr);
  }
  static void from_json(const json& j, std::optional<T>& value) {
    if (j.is_null()) {
      value.reset();
    } else {
      value = j.get<T>();
    }
  }
};

}  // namespace nlohmann

namespace phongpipe {

template <typename Json, typename Record, typename = std::enable_if_t<HasFields<Record>::value>>
void to_json(Json& j, const Record& record) {
  for_each_field(record,
                 [&j](std::string_view name, const auto& value) { j[std::string(name)] = value; });
}

template <typename Json, typename Record, typename = std::enable_if_t<HasFields<Record>::value>>
void from_json(const Json& j, Record& record) {
  for_each_field(
      record, [&j](std::string_view name, auto& value) { j.at(std::string(name)).get_to(value); });
}

// For a pipe: compact, with exact doubles.
template <typename Record>
std::string to_bytes(const Record& record) {
  std::string bytes;
  nlohmann::json::to_cbor(nlohmann::json(record), bytes);
  return bytes;
}

template <typename Record>
Record from_bytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes).get<Record>();
}

}  // namespace phongpipe
