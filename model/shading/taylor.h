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

// V = A x + B y + C, and the dot products, divided by |C|², that its length depends on.
template <typename T>
struct ScaledVector {
  Linear<Vector3<T>> vector;
  T squared_length, root;  // |C|², 1/|C|
  T g, h;                  // A·C/|C|², B·C/|C|²
  T aa, ab, bb;            // A·A/|C|², A·B/|C|², B·B/|C|²

  explicit ScaledVector(const Linear<Vector3<T>>& v) : ScaledVector(v, v.c.dot(v.c)) {}
  // For a V that may vanish. `positive`: |C|², kept away from 0.
  ScaledVector(const Linear<Vector3<T>>& v, const T& positive)
      : vector(v), squared_length(positive), root(rsqrt(positive)) {
    const T inverse = root * root;
    g = v.a.dot(v.c) * inverse;
    h = v.b.dot(v.c) * inverse;
    aa = v.a.dot(v.a) * inverse;
    ab = v.a.dot(v.b) * inverse;
    bb = v.b.dot(v.b) * inverse;
  }
};

// The part common to all series over the same normals: N = A x + B y + C and its length to second
// order.
template <typename T>
class NormalExpansion {
 public:
  explicit NormalExpansion(const Linear<Vector3<T>>& normal)
      : NormalExpansion(ScaledVector<T>(normal)) {}
  explicit NormalExpansion(const ScaledVector<T>& normal)
      : n_(normal),
        q5_(half(n_.g * n_.g - n_.aa)),
        q4_(n_.g * n_.h - n_.ab),
        q3_(half(n_.h * n_.h - n_.bb)) {}

  // |N|
  Quadratic<T> length() const {
    const Quadratic<T> t = {T(1), n_.h, n_.g, -q3_, -q4_, -q5_};
    return t.scaled(n_.squared_length * n_.root);
  }

  // N·M / |N| for a constant unit M: the direction to a light at infinity, or a constant halfway
  // vector.
  Quadratic<T> infinite(const Vector3<T>& m) const {
    Quadratic<T> t;
    t.t0 = n_.vector.c.dot(m) * n_.root;
    t.t2 = n_.vector.a.dot(m) * n_.root - t.t0 * n_.g;
    t.t1 = n_.vector.b.dot(m) * n_.root - t.t0 * n_.h;
    t.t5 = t.t0 * q5_ - n_.g * t.t2;
    t.t4 = t.t0 * q4_ - n_.g * t.t1 - n_.h * t.t2;
    t.t3 = t.t0 * q3_ - n_.h * t.t1;
    return t;
  }

  // N·M / (|N||M|) for M = D x + E y + F: the halfway vector of an eye at a finite distance.
  Quadratic<T> finite(const Linear<Vector3<T>>& m) const { return finite(ScaledVector<T>(m)); }
  Quadratic<T> finite(const ScaledVector<T>& m) const {
    const Linear<Vector3<T>>&n = n_.vector, &v = m.vector;
    const T root = n_.root * m.root;
    const T u = n_.g + m.g, w = n_.h + m.h;  // J, K of the normal are g, h; P, Q of M
    const T jp = n_.g - m.g, kq = n_.h - m.h;
    // q5_ holds (J² − |A|²)/2; the series wants ((J − P)² − |A|² − |D|²)/2, and so on.
    const T r5 = q5_ + half(jp * jp - n_.g * n_.g - m.aa);
    const T r4 = q4_ + (jp * kq - n_.g * n_.h - m.ab);
    const T r3 = q3_ + half(kq * kq - n_.h * n_.h - m.bb);
    Quadratic<T> t;
    t.t0 = n.c.dot(v.c) * root;
    t.t2 = (n.a.dot(v.c) + n.c.dot(v.a)) * root - t.t0 * u;
    t.t1 = (n.b.dot(v.c) + n.c.dot(v.b)) * root - t.t0 * w;
    t.t5 = n.a.dot(v.a) * root - u * t.t2 + t.t0 * r5;
    t.t3 = n.b.dot(v.b) * root - w * t.t1 + t.t0 * r3;
    t.t4 = (n.a.dot(v.b) + n.b.dot(v.a)) * root - u * t.t1 - w * t.t2 + t.t0 * r4;
    return t;
  }

 private:
  ScaledVector<T> n_;
  T q5_, q4_, q3_;  // (g² − |A|²/|C|²)/2, gh − A·B/|C|², (h² − |B|²/|C|²)/2
};

}  // namespace phongpipe
