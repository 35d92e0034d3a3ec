// One series of the pixel loop: v' = v + d1, d1' = d1 + d2. Two additions a pixel, no rounding; all
// three registers wrap at the width, which is exact as long as the values of covered pixels fit.
#pragma once

#include <cstdint>

#include "model/fixed/fixed_point.h"

namespace phongpipe {

// T5 x² + T4 xy + T3 y² + T2 x + T1 y + T0 with x and y in whole pixels from the expansion point.
struct FixedQuadratic {
  std::int64_t t0 = 0, t1 = 0, t2 = 0, t3 = 0, t4 = 0, t5 = 0;

  // Value and first difference along x at (x, y), modulo 2^64.
  std::int64_t value(std::int64_t x, std::int64_t y) const {
    const std::int64_t along_x = wrap_add(wrap_add(wrap_mul(t5, x), wrap_mul(t4, y)), t2);
    const std::int64_t along_y = wrap_add(wrap_mul(t3, y), t1);
    return wrap_add(wrap_add(wrap_mul(along_x, x), wrap_mul(along_y, y)), t0);
  }
  std::int64_t difference(std::int64_t x, std::int64_t y) const {
    return wrap_add(wrap_add(wrap_mul(t5, 2 * x + 1), wrap_mul(t4, y)), t2);
  }
};

// c + a x + b y, with x and y as in FixedQuadratic.
struct FixedLinear {
  std::int64_t c = 0, a = 0, b = 0;

  std::int64_t value(std::int64_t x, std::int64_t y) const {
    return wrap_add(c, wrap_add(wrap_mul(a, x), wrap_mul(b, y)));
  }
};

// Values that the datapath's registers are loaded with at the start of a span.
struct SeriesStart {
  std::int64_t v = 0;   // value at the first pixel
  std::int64_t d1 = 0;  // difference to the next pixel
  std::int64_t d2 = 0;  // difference of the differences, 2 T5

  // What the datapath adds from pixel to pixel: nothing if the series does not step along the span.
  SeriesStart stepped(bool stepping) const { return stepping ? *this : SeriesStart{v, 0, 0}; }
};

// Start of the pixels `lane`, lane + lanes, lane + 2 lanes … of a span, which steps by `lanes`.
inline SeriesStart lane_start(const SeriesStart& span, std::int64_t lane, std::int64_t lanes) {
  const auto sum = [&](std::int64_t constant, std::int64_t d1, std::int64_t d2) {
    return wrap_add(constant, wrap_add(wrap_mul(span.d1, d1), wrap_mul(span.d2, d2)));
  };
  return {sum(span.v, lane, lane * (lane - 1) / 2),
          sum(0, lanes, lanes * (lanes - 1) / 2 + lanes * lane), sum(0, 0, lanes * lanes)};
}

class ForwardDifferencer {
 public:
  explicit ForwardDifferencer(int width = 64) : width_(width) {}

  void load(const SeriesStart& start) {
    v_ = wrap_to(start.v, width_);
    d1_ = wrap_to(start.d1, width_);
    d2_ = wrap_to(start.d2, width_);
  }
  void step() {
    v_ = wrap_to(wrap_add(v_, d1_), width_);
    d1_ = wrap_to(wrap_add(d1_, d2_), width_);
  }
  std::int64_t v() const { return v_; }
  std::int64_t d1() const { return d1_; }
  std::int64_t d2() const { return d2_; }

 private:
  int width_;
  std::int64_t v_ = 0, d1_ = 0, d2_ = 0;
};

}  // namespace phongpipe
