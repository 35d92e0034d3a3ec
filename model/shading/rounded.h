// A scalar of reduced precision. Every operation on it is rounded to a number of mantissa bits, so
// that running a formula template with it shows what narrower arithmetic costs in accuracy.
//
// An operation is computed in double and then rounded to nearest, ties to even: that the result was
// rounded to 53 bits before moves it by at most 2^(bits−52) of a unit in the last place. The
// exponent has the range of double.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "model/shading/scalar.h"

namespace phongpipe {

class Rounded {
 public:
  // Bits of the mantissa after the leading one, as double has 52. For the current thread, while the
  // object exists; not nested.
  class Precision {
   public:
    explicit Precision(int mantissa_bits) { dropped_bits() = 52 - mantissa_bits; }
    ~Precision() { dropped_bits() = 0; }
    Precision(const Precision&) = delete;
    Precision& operator=(const Precision&) = delete;
  };

  Rounded() = default;
  Rounded(double value)
      : value_(rounded(value)) {}  // NOLINT(google-explicit-constructor):
                                   // constants appear in the formulas
  double value() const { return value_; }

  Rounded operator-() const { return exactly(-value_); }
  friend Rounded operator+(const Rounded& a, const Rounded& b) { return {a.value_ + b.value_}; }
  friend Rounded operator-(const Rounded& a, const Rounded& b) { return {a.value_ - b.value_}; }
  friend Rounded operator*(const Rounded& a, const Rounded& b) { return {a.value_ * b.value_}; }
  friend Rounded operator/(const Rounded& a, const Rounded& b) { return {a.value_ / b.value_}; }
  Rounded& operator+=(const Rounded& b) { return *this = *this + b; }
  Rounded& operator-=(const Rounded& b) { return *this = *this - b; }
  Rounded& operator*=(const Rounded& b) { return *this = *this * b; }
  friend Rounded rsqrt(const Rounded& x) { return {phongpipe::rsqrt(x.value_)}; }
  friend Rounded power(const Rounded& x, const Rounded& p) {
    return {phongpipe::power(x.value_, p.value_)};
  }
  friend Rounded half(const Rounded& x) { return exactly(0.5 * x.value_); }
  friend Rounded twice(const Rounded& x) { return exactly(2 * x.value_); }
  friend Rounded maximum(const Rounded& a, const Rounded& b) { return a.value_ > b.value_ ? a : b; }

 private:
  static int& dropped_bits() {
    thread_local int bits = 0;
    return bits;
  }
  static Rounded exactly(double value) {
    Rounded result;
    result.value_ = value;
    return result;
  }
  static double rounded(double value) {
    const int dropped = dropped_bits();
    if (dropped == 0 || !std::isfinite(value)) return value;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    const std::uint64_t half_unit = std::uint64_t{1} << (dropped - 1);
    bits += half_unit - 1 + (bits >> dropped & 1);  // a carry goes into the exponent
    bits &= ~(2 * half_unit - 1);
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  double value_ = 0;
};

}  // namespace phongpipe

namespace Eigen {
template <>
struct NumTraits<phongpipe::Rounded> : NumTraits<double> {
  using Real = phongpipe::Rounded;
  using NonInteger = phongpipe::Rounded;
  using Nested = phongpipe::Rounded;
};
}  // namespace Eigen
