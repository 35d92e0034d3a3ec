// The tables of Duff's method and of angle interpolation.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "model/shading/methods/angle_interpolation.h"
#include "model/shading/methods/duff.h"

namespace phongpipe {
namespace {

constexpr int kRootBits = 9;
constexpr std::size_t kRootWords = std::size_t{1} << kRootBits;  // for each parity of the exponent
constexpr double kPi = 3.14159265358979323846;

// Over [1, 2) and [2, 4), each word for the middle of its interval.
std::array<double, 2 * kRootWords> root_table() {
  std::array<double, 2 * kRootWords> words = {};
  for (std::size_t i = 0; i < kRootWords; ++i) {
    const double x = 1 + (static_cast<double>(i) + 0.5) / static_cast<double>(kRootWords);
    words[i] = 1 / std::sqrt(x);
    words[kRootWords + i] = 1 / std::sqrt(2 * x);
  }
  return words;
}

}  // namespace

double table_rsqrt(double x) {
  static const std::array<double, 2 * kRootWords> table = root_table();
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const auto exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
  if (exponent <= -1023 || exponent > 1023) return 1 / std::sqrt(x);  // zero, negative, not finite
  const auto odd = static_cast<std::size_t>(exponent & 1);
  const double word = table[odd * kRootWords + (bits >> (52 - kRootBits)) % kRootWords];
  std::memcpy(&bits, &word, sizeof bits);
  bits -= static_cast<std::uint64_t>(exponent >> 1) << 52;
  double result = 0;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

const LookupTable& cosine_table() {
  static const LookupTable table(kRightAngle + 1, kRightAngle, [](double byte) {
    return std::sin((kRightAngle - byte) / kRightAngle * kPi / 2);  // exactly 0 at 90°
  });
  return table;
}

double angle_byte(double cosine) {
  const double angle = std::acos(std::fmin(1.0, not_negative(cosine)));
  return std::floor(angle / (kPi / 2) * kRightAngle + 0.5);
}

Recorded angle_byte(const Recorded& cosine) {
  return read_word(cosine);
}

}  // namespace phongpipe
