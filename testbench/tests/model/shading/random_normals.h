// Random directions, and the normals of triangles as NUMERICS has them: three on a cone.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "model/shading/scalar.h"
#include "testbench/system/random.h"

namespace phongpipe {

using Vec = Vector3<double>;

constexpr double kDegrees = 3.14159265358979323846 / 180;

class RandomNormals : public Random {
 public:
  using Random::Random;

  // `angle` from a random axis, roughly evenly around it; the first one's turn is below `turn`.
  // Radians.
  std::array<Vec, 3> cone(double angle, double turn) {
    const Vec axis = unit(), side = axis.cross(unit()).normalized(), up = axis.cross(side);
    const double start = uniform(0, turn);
    std::array<Vec, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      const double around = start + (120 * static_cast<double>(i) + uniform(-40, 40)) * kDegrees;
      result[i] = std::cos(angle) * axis +
                  std::sin(angle) * (std::cos(around) * side + std::sin(around) * up);
    }
    return result;
  }
};

}  // namespace phongpipe
