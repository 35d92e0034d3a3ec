// Quadratics over a triangle in barycentric coordinates. The sample points of a fit are fixed in
// these coordinates, so a fit does not depend on x and y. One change of basis turns its result into
// the T_i.
#pragma once

#include <array>

#include "model/shading/taylor.h"

namespace phongpipe {

// A quadratic, given by its values at the corners and at the midpoints of the edges. Edge i is
// opposite corner i.
template <typename T>
struct SixValues {
  std::array<T, 3> corner, middle;
};

// Converts a quadratic in barycentric coordinates to x and y. `u` and `v`: the coordinates of
// corners 1 and 2 as functions of x and y.
template <typename T>
class BarycentricBasis {
 public:
  BarycentricBasis(const Linear<T>& u, const Linear<T>& v)
      : u_(u),
        v_(v),
        xx_({u.a * u.a, u.a * v.a, v.a * v.a}),
        xy_({twice(u.a * u.b), u.a * v.b + u.b * v.a, twice(v.a * v.b)}),
        yy_({u.b * u.b, u.b * v.b, v.b * v.b}) {}

  Quadratic<T> operator()(const SixValues<T>& q) const {
    // q = c + du·u + dv·v + uu·u² + uv·uv + vv·v²
    const T uu = twice(q.corner[0] + q.corner[1] - twice(q.middle[2]));
    const T vv = twice(q.corner[0] + q.corner[2] - twice(q.middle[1]));
    const T uv = twice(twice(q.corner[0] + q.middle[0] - q.middle[1] - q.middle[2]));
    const T du = q.corner[1] - q.corner[0] - uu;
    const T dv = q.corner[2] - q.corner[0] - vv;

    const T u1 = uu * u_.c, uv1 = uv * v_.c, v1 = vv * v_.c;
    const T along_u = du + u1 + uv1;  // q at the origin is c + along_u·u + along_v·v
    const T along_v = dv + v1;
    const T slope_u = along_u + u1;
    const T slope_v = along_v + v1 + uv * u_.c;
    Quadratic<T> t;
    t.t5 = uu * xx_[0] + uv * xx_[1] + vv * xx_[2];
    t.t4 = uu * xy_[0] + uv * xy_[1] + vv * xy_[2];
    t.t3 = uu * yy_[0] + uv * yy_[1] + vv * yy_[2];
    t.t2 = slope_u * u_.a + slope_v * v_.a;
    t.t1 = slope_u * u_.b + slope_v * v_.b;
    t.t0 = q.corner[0] + along_u * u_.c + along_v * v_.c;
    return t;
  }

 private:
  Linear<T> u_, v_;
  std::array<T, 3> xx_, xy_, yy_;  // coefficients of x², xy, y² in u², uv, v²
};

}  // namespace phongpipe
