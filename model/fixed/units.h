// The unit for 1/√x of hw/units/, bit for bit; the other units there are exact.
#pragma once

#include <cstdint>
#include <vector>

namespace phongpipe {

// x is unsigned 2.(width − 2), from 1 to below 4, and its root unsigned 0.width. The root is
// interpolated between the middles of 2^table_bits intervals over 0 to 4, at most 2 LSB off for the
// default (all x: UnitsRtl.RootsAreTheModels).
struct RsqrtFormat {
  int width = 16, table_bits = 9, slope_bits = 8;

  int delta_bits() const { return width - table_bits; }
};

struct RsqrtWord {
  std::uint32_t root = 0;   // at the middle of the interval, 0.width
  std::uint32_t slope = 0;  // what it falls by over the interval, slope_bits bits of that weight
};

// A word for each interval; 0 for those below 1. Rounded to nearest, the slope at most all ones.
std::vector<RsqrtWord> rsqrt_table(const RsqrtFormat& format);

// root − ⌊slope · (distance from the middle) / 2^delta_bits⌋
std::uint32_t rsqrt_word(const RsqrtFormat& format, const std::vector<RsqrtWord>& table,
                         std::uint32_t x);

}  // namespace phongpipe
