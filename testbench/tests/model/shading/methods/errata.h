// What tests of printed formulas have in common.
#pragma once

#include "model/scene/scene.h"

namespace phongpipe {

constexpr double kLarge = 0.05;  // what a printed form misses by, at least, as a cosine

inline Vec3 mirrored(const Vec3& v, const Vec3& unit_normal) {
  return 2 * unit_normal.dot(v) * unit_normal - v;
}

}  // namespace phongpipe
