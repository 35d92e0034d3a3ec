// depth_cue: moves a pixel towards the cue colour.
#pragma once

#include <algorithm>
#include <cstdint>

#include "model/fixed/constants.h"

namespace phongpipe {

// The share of the pixel's own colour, 0 to 2^kCueFactorBits, from the series' value.
inline std::int32_t cue_factor(std::int64_t v) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(v >> (kCueFraction - kCueFactorBits), 0,
                                                            std::int64_t{1} << kCueFactorBits));
}

// cue + (sum − cue)·factor, rounded to nearest. `sum` is in output LSB, rounded, not negative and
// not yet saturated, so that overexposed pixels fade correctly.
inline std::int32_t faded(std::int32_t sum, std::int32_t cue, std::int32_t factor) {
  constexpr std::int32_t kHalf = 1 << (kCueFactorBits - 1);
  return cue + (((sum - cue) * factor + kHalf) >> kCueFactorBits);
}

// The same, saturated.
inline std::uint8_t depth_cue(std::int32_t sum, std::int32_t cue, std::int32_t factor) {
  return static_cast<std::uint8_t>(std::min(faded(sum, cue, factor), kOutputMax));
}

}  // namespace phongpipe
