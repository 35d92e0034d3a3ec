#include "model/fixed/units.h"

#include <algorithm>
#include <cmath>

namespace phongpipe {

std::vector<RsqrtWord> rsqrt_table(const RsqrtFormat& format) {
  const std::size_t intervals = std::size_t{1} << format.table_bits;
  const double interval = 4 / static_cast<double>(intervals), one = std::ldexp(1, format.width);
  const auto steepest = static_cast<std::uint32_t>((1U << format.slope_bits) - 1);
  std::vector<RsqrtWord> table(intervals);
  for (std::size_t i = intervals / 4; i < intervals; ++i) {
    const double low = static_cast<double>(i) * interval, high = low + interval;
    const double middle = one / std::sqrt((low + high) / 2);
    const double fall = one / std::sqrt(low) - one / std::sqrt(high);
    const std::uint32_t slope = std::min(static_cast<std::uint32_t>(std::lround(fall)), steepest);
    // The root of 1, at the beginning of the first interval, is all ones.
    const std::uint32_t most = (1U << format.width) - 1 - (slope + 1) / 2;
    table[i] = {std::min(static_cast<std::uint32_t>(std::lround(middle)), most), slope};
  }
  return table;
}

std::uint32_t rsqrt_word(const RsqrtFormat& format, const std::vector<RsqrtWord>& table,
                         std::uint32_t x) {
  const int bits = format.delta_bits();
  const RsqrtWord& word = table[x >> bits];
  const auto delta =
      static_cast<std::int64_t>(x & ((1U << bits) - 1)) - (std::int64_t{1} << (bits - 1));
  const std::int64_t fall = (static_cast<std::int64_t>(word.slope) * delta) >> bits;
  const std::uint32_t mask = (1U << format.width) - 1;
  return static_cast<std::uint32_t>(static_cast<std::int64_t>(word.root) - fall) & mask;
}

}  // namespace phongpipe
