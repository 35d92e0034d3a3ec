#include "model/files/scene_values.h"

#include <fmt/format.h>

#include <cmath>

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
  // A vector that was written by us keeps its last bits.
  constexpr double kUnit = 1e-12;
  return std::abs(value.norm() - 1) > kUnit ? value.normalized() : value;
}

Color color(const TomlTable& table, std::string_view key) {
  return Color(table.color(key).data());
}

Color color(const TomlTable& table, std::string_view key, const Color& fallback) {
  return table.has(key) ? color(table, key) : fallback;
}

Material read_material(const std::string& name, const TomlTable& table) {
  Material material;
  material.name = name;
  material.ambient = color(table, "ambient");
  material.diffuse = color(table, "diffuse");
  material.specular = color(table, "specular");
  material.shininess = table.number("shininess", kNotNegative);
  table.finish();
  return material;
}

}  // namespace phongpipe
