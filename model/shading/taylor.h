// Bishop & Weimer's second-degree Taylor series of s(x, y) = N·M / (|N||M|) about the origin, with
// N and M linear in x and y. The paper prints some coefficients wrongly; these are the corrected
// ones, in the scaled form that divides by |C| (and |F|) first.
#pragma once

#include "model/shading/linear.h"

namespace phongpipe {

// T5 x² + T4 xy + T3 y² + T2 x + T1 y + T0
template <typename T>
struct Quadratic {
  T t0, t1, t2, t3, t4, t5;

  T operator()(const T& x, const T& y) const {
    return (t5 * x + t4 * y + t2) * x + (t3 * y + t1) * y + t0;
  }
  Quadratic scaled(const T& k) const { return {t0 * k, t1 * k, t2 * k, t3 * k, t4 * k, t5 * k}; }
};

// What every series over the same normals shares: N = A x + B y + C and its length to second order.
template <typename T>
class NormalExpansion {
 public:
  explicit NormalExpansion(const Linear<Vector3<T>>& normal) : normal_(normal) {
    root_ = rsqrt(normal.c.dot(normal.c));
    const T inverse = root_ * root_;
    g_ = normal.a.dot(normal.c) * inverse;
    h_ = normal.b.dot(normal.c) * inverse;
    q5_ = half(g_ * g_ - normal.a.dot(normal.a) * inverse);
    q4_ = g_ * h_ - normal.a.dot(normal.b) * inverse;
    q3_ = half(h_ * h_ - normal.b.dot(normal.b) * inverse);
  }

  // M constant and of unit length: a light or a halfway vector at infinity.
  Quadratic<T> infinite(const Vector3<T>& m) const {
    Quadratic<T> t;
    t.t0 = normal_.c.dot(m) * root_;
    t.t2 = normal_.a.dot(m) * root_ - t.t0 * g_;
    t.t1 = normal_.b.dot(m) * root_ - t.t0 * h_;
    t.t5 = t.t0 * q5_ - g_ * t.t2;
    t.t4 = t.t0 * q4_ - g_ * t.t1 - h_ * t.t2;
    t.t3 = t.t0 * q3_ - h_ * t.t1;
    return t;
  }

  // M = D x + E y + F: the halfway vector of an eye at a finite distance.
  Quadratic<T> finite(const Linear<Vector3<T>>& m) const {
    const T root_m = rsqrt(m.c.dot(m.c));
    const T inverse_m = root_m * root_m;
    const T root = root_ * root_m;
    const T p = m.a.dot(m.c) * inverse_m;  // J, K of the normal are g_, h_; P, Q of M
    const T q = m.b.dot(m.c) * inverse_m;
    const T u = g_ + p, w = h_ + q;
    const T jp = g_ - p, kq = h_ - q;
    // q5_ holds (J² − |A|²)/2; the series wants ((J − P)² − |A|² − |D|²)/2, and so on.
    const T r5 = q5_ + half(jp * jp - g_ * g_ - m.a.dot(m.a) * inverse_m);
    const T r4 = q4_ + (jp * kq - g_ * h_ - m.a.dot(m.b) * inverse_m);
    const T r3 = q3_ + half(kq * kq - h_ * h_ - m.b.dot(m.b) * inverse_m);
    Quadratic<T> t;
    t.t0 = normal_.c.dot(m.c) * root;
    t.t2 = (normal_.a.dot(m.c) + normal_.c.dot(m.a)) * root - t.t0 * u;
    t.t1 = (normal_.b.dot(m.c) + normal_.c.dot(m.b)) * root - t.t0 * w;
    t.t5 = normal_.a.dot(m.a) * root - u * t.t2 + t.t0 * r5;
    t.t3 = normal_.b.dot(m.b) * root - w * t.t1 + t.t0 * r3;
    t.t4 = (normal_.a.dot(m.b) + normal_.b.dot(m.a)) * root - u * t.t1 - w * t.t2 + t.t0 * r4;
    return t;
  }

 private:
  Linear<Vector3<T>> normal_;
  T root_;          // 1/|C|
  T g_, h_;         // A·C/|C|², B·C/|C|²
  T q5_, q4_, q3_;  // (g² − |A|²/|C|²)/2, gh − A·B/|C|², (h² − |B|²/|C|²)/2
};

}  // namespace phongpipe
