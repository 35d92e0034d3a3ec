// The ways in which the pixels of a triangle are shaded, and counts by them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "model/shading/fields.h"

namespace phongpipe {

enum class ShadingPath {
  taylor,  // both series of the light by this fit, or the cheaper one by a cheaper fit
  six_point,
  weighted,
  focused,
  subdivided,  // by some fit, on a piece of a triangle that was split
  exact_path,  // pixel by pixel, see exact_path.h
  refused      // the same, where even it proves no error
};
constexpr std::size_t kShadingPaths = 7;

// A count for each path.
struct Ledger {
  std::array<std::uint64_t, kShadingPaths> counts{};

  std::uint64_t& operator[](ShadingPath path) { return counts[static_cast<std::size_t>(path)]; }
  std::uint64_t operator[](ShadingPath path) const {
    return counts[static_cast<std::size_t>(path)];
  }
  std::uint64_t sum() const {
    std::uint64_t total = 0;
    for (const std::uint64_t count : counts) total += count;
    return total;
  }

  static constexpr auto fields() { return std::make_tuple(field("counts", &Ledger::counts)); }
};

// In the order of ShadingPath.
constexpr std::array<std::string_view, kShadingPaths> kShadingPathNames = {
    "taylor", "six_point", "weighted", "focused", "subdivided", "exact_path", "refused"};

}  // namespace phongpipe
