// Vectors and colours from TOML, and the ranges a scene's numbers must keep.
#pragma once

#include <string_view>

#include "model/files/toml_reader.h"
#include "model/scene/mesh.h"

namespace phongpipe {

// Ranges far below the overflow of squares and products in double, so that no later result is
// infinite.
inline constexpr NumberRange kCoordinate = {-kMaxCoordinate, kMaxCoordinate};
inline constexpr NumberRange kSize = {1e-9, 1e9};
inline constexpr NumberRange kNotNegative = {0, 1e9};
inline constexpr double kShortestVector = 1e-9;  // anything shorter counts as zero

Vec3 vector(const TomlTable& table, std::string_view key);
Vec3 vector(const TomlTable& table, std::string_view key, const Vec3& fallback);
Vec3 unit_vector(const TomlTable& table, std::string_view key);
Color color(const TomlTable& table, std::string_view key);
Color color(const TomlTable& table, std::string_view key, const Color& fallback);
// All of a material but its name.
Material read_material(const std::string& name, const TomlTable& table);

}  // namespace phongpipe
