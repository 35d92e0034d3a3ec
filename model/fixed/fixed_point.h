// Two's-complement numbers of run-time width, held in 64 bits.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace phongpipe {

// Addition and multiplication modulo 2^64, as registers wrap. C++ defines wrapping for unsigned
// types only.
inline std::int64_t wrap_add(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
inline std::int64_t wrap_mul(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(b));
}

// Keeps the low `width` bits, sign-extended: a register of that width.
inline std::int64_t wrap_to(std::int64_t value, int width) {
  const int unused = 64 - width;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << unused) >> unused;
}

inline bool fits(std::int64_t value, int width) {
  return wrap_to(value, width) == value;
}

// Nearest multiple of 2^−fraction_bits, from 0 to 62, ties away from zero. Sets `overflow` and
// returns 0 if the result does not fit in 63 bits or is NaN.
inline std::int64_t to_fixed(double value, int fraction_bits, bool& overflow) {
  const double scaled = value * static_cast<double>(std::int64_t{1} << fraction_bits);
  if (!(std::fabs(scaled) < 0x1p62)) {
    overflow = true;
    return 0;
  }
  const auto whole = static_cast<std::int64_t>(scaled);
  const double rest = scaled - static_cast<double>(whole);  // exact
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

// Drops `bits` fraction bits, rounding to nearest, ties up.
inline std::int64_t round_off(std::int64_t value, int bits) {
  if (bits == 0) return value;
  return wrap_add(value, std::int64_t{1} << (bits - 1)) >> bits;
}

}  // namespace phongpipe
