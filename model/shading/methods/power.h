// Ways of computing the power of Phong's highlight: x^n for a cosine x.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "model/shading/methods/lookup.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

enum class PowerKind {
  exact,    // x^n itself; no unit computes it, and it is counted as a table read
  table,    // Bishop & Weimer: a table of 1,024 words, 1 read
  schlick,  // Schlick 1994: x / (n − n x + x)
  lyon4,    // Lyon 1993: (1 − (n/γ)(1 − x))^γ, 0 below x = 1 − γ/n, by squaring; γ = 4
  lyon8,    // γ = 8
  lyon16,   // γ = 16
};

const std::vector<PowerKind>& power_kinds();
std::string_view name(PowerKind kind);

class Power {
 public:
  Power(PowerKind kind, double n);

  PowerKind kind() const { return kind_; }
  double shininess() const { return n_; }

  // For x of at most 1. A negative x counts as 0 (and 0^0 as 1), as in exact Phong shading.
  double operator()(double x) const;
  Recorded operator()(const Recorded& x) const { return unit(x); }

 private:
  template <typename T>
  T unit(const T& x) const;
  int squarings() const;

  PowerKind kind_;
  double n_;
  std::shared_ptr<const LookupTable> table_;
};

template <typename T>
T Power::unit(const T& x) const {
  if (kind_ == PowerKind::exact || kind_ == PowerKind::table) return lookup(*table_, x);
  if (kind_ == PowerKind::schlick) return x / (T(1 - n_) * x + T(n_));
  // 1 − k(1 − x) as (1 − k) + k x: a material's constants are computed once.
  const double k = n_ / (1 << squarings());
  T power = not_negative(T(k) * x + T(1 - k));
  for (int i = 0; i < squarings(); ++i) power = power * power;
  return power;
}

}  // namespace phongpipe
