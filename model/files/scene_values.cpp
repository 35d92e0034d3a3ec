#include "model/files/scene_values.h"

#include <fmt/format.h>

namespace phongpipe {

Vec3 vector(const TomlTable& table, std::string_view key) {
  return Vec3(table.triple(key, kCoordinate).data());
}

Vec3 vector(const TomlTable& table, std::string_view key, const Vec3& fallback) {
  return table.has(key) ? vector(table, key) : fallback;
}

Vec3 unit_vector(const TomlTable& table, std::string_view key) {
  const Vec3 value = vector(table, key);
  if (value.norm() < kShortestVector) {
    table.fail(key, fmt::format("{} must not be zero", key));
  }
  return value.normalized();
}

Color color(const TomlTable& table, std::string_view key) {
  return Color(table.color(key).data());
}

Color color(const TomlTable& table, std::string_view key, const Color& fallback) {
  return table.has(key) ? color(table, key) : fallback;
}

}  // namespace phongpipe
