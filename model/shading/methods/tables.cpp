// The tables of Duff's method and of angle interpolation.
#include <cmath>

#include "model/shading/methods/angle_interpolation.h"
#include "model/shading/methods/duff.h"

namespace phongpipe {
namespace {

constexpr int kRootWords = 1024;
constexpr double kPi = 3.14159265358979323846;

}  // namespace

const LookupTable& reciprocal_root_table() {
  static const LookupTable table(kRootWords, 3, [](double x) { return 1 / std::sqrt(1 + x); });
  return table;
}

double table_rsqrt(double x) {
  int exponent = 0;
  double fraction = std::frexp(x, &exponent) * 2;  // 1 ≤ fraction < 2
  --exponent;
  if (exponent % 2 != 0) {
    fraction *= 2;
    --exponent;
  }
  return std::ldexp(reciprocal_root_table().at(fraction - 1), -exponent / 2);
}

const LookupTable& cosine_table() {
  static const LookupTable table(kRightAngle + 1, kRightAngle, [](double byte) {
    return std::cos(byte / kRightAngle * kPi / 2);
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
