// The end of the datapath: clamps the diffuse series at ambient light, decides whether the specular
// word counts, adds and saturates to the output.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// `level` is ambient light plus the rounding half, in the format of the diffuse series: a series at
// or below it is unlit (N·L ≤ 0), because ambient and half are folded into its T0.
inline bool is_lit(std::int64_t diffuse, std::int64_t level) {
  return diffuse > level;
}

// The diffuse value, at least `level`, truncated to sum_fraction_bits(). Never negative, because
// level is not.
inline std::int32_t clamped_diffuse(const DatapathConfiguration& configuration,
                                    std::int64_t diffuse, std::int64_t level) {
  return static_cast<std::int32_t>(
      std::max(diffuse, level) >>
      (configuration.diffuse_fraction_bits - configuration.sum_fraction_bits()));
}

// A ROM word in units of 2^−sum_fraction_bits output LSB, as color_sum adds it.
inline std::int32_t aligned_word(const DatapathConfiguration& configuration, std::int32_t word) {
  return word << std::max(0, kOutputBits - configuration.rom_data_bits);
}

// In output LSB, not saturated, because depth cueing comes first.
inline std::int32_t light_sum(const DatapathConfiguration& configuration, std::int32_t diffuse,
                              std::int32_t aligned) {
  return (diffuse + aligned) >> configuration.sum_fraction_bits();
}

inline std::uint8_t color_sum(const DatapathConfiguration& configuration, std::int32_t diffuse,
                              std::int32_t aligned) {
  return static_cast<std::uint8_t>(
      std::min(light_sum(configuration, diffuse, aligned), kOutputMax));
}

}  // namespace phongpipe
