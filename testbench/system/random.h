// Random numbers that are the same on every machine and with every compiler, unlike those of the
// standard library's distributions.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "model/scene/scene.h"

namespace phongpipe {

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}

  std::int64_t bits() { return static_cast<std::int64_t>(generator_()); }  // 64 of them

  // From 0 to count − 1, equally likely.
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t surplus = (0 - count) % count;  // 2^64 modulo count
    std::uint64_t value = generator_();
    while (value < surplus) value = generator_();
    return value % count;
  }
  // From low to high, both included and equally likely.
  int integer(int low, int high) {
    const auto count = static_cast<std::uint64_t>(std::int64_t{high} - low) + 1;
    return static_cast<int>(low + static_cast<std::int64_t>(below(count)));
  }
  // In steps of 2^-53 of the range. std::fma rounds exactly once, whatever the compiler.
  double uniform(double low, double high) {
    const double share = std::ldexp(static_cast<double>(generator_() >> 11), -53);
    return std::fma(high - low, share, low);
  }

  Vec3 unit() {
    for (;;) {
      const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }
  Vec3 unit_near(const Vec3& axis, double largest_degrees) {  // uniform in angle, not in area
    const Vec3 side = axis.cross(unit()).normalized();
    const double angle = uniform(0, largest_degrees) * 3.14159265358979323846 / 180;
    return std::cos(angle) * axis + std::sin(angle) * side;
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace phongpipe
