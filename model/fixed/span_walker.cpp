#include "model/fixed/span_walker.h"

#include <cmath>

namespace phongpipe {
namespace {

// Whether every value v + d1 i + d2 i(i−1)/2, 0 ≤ i < length, lies within ±limit. Computed in
// double, which is exact enough for a bound and does not wrap.
bool within(double v, double d1, double d2, int length, double limit) {
  const auto value = [&](double i) { return v + i * (d1 + 0.5 * d2 * (i - 1)); };
  if (std::fabs(v) > limit || std::fabs(value(length - 1)) > limit) return false;
  if (d2 == 0) return true;
  const double vertex = 0.5 - d1 / d2;
  if (!(vertex > 0 && vertex < length - 1)) return true;
  return std::fabs(value(std::floor(vertex))) <= limit &&
         std::fabs(value(std::ceil(vertex))) <= limit;
}

}  // namespace

SpanWalker::SpanWalker(const FrameSetup& frame)
    : configuration_(frame.configuration),
      dropped_bits_(setup_fraction_bits(frame.configuration, 0)),
      unit_(std::ldexp(1.0, dropped_bits_)),
      diffuse_limit_(std::ldexp(1.0, configuration_.diffuse_width() - 1) - 1),
      specular_limit_(std::ldexp(1.0, configuration_.specular_width() - 1) - 1) {}

SeriesStart SpanWalker::start_series(const FixedQuadratic& t, const TriangleSetup& setup,
                                     const RowSpan& row, double limit, bool& overflow) const {
  const int x = row.x - setup.x, y = row.y - setup.y;
  const SeriesStart start = {round_off(t.value(x, y), dropped_bits_),
                             round_off(t.difference(x, y), dropped_bits_),
                             round_off(wrap_mul(2, t.t5), dropped_bits_)};
  const auto real = [](std::int64_t coefficient) { return static_cast<double>(coefficient); };
  const double v = (real(t.t5) * x + real(t.t4) * y + real(t.t2)) * x +
                   (real(t.t3) * y + real(t.t1)) * y + real(t.t0);
  const double d1 = real(t.t5) * (2 * x + 1) + real(t.t4) * y + real(t.t2);
  // The last representable value, less what rounding the start can move a value by.
  const double drift = 1 + row.length + 0.5 * row.length * (row.length - 1.0);
  if (!within(v, d1, 2 * real(t.t5), row.length, (limit - drift) * unit_)) overflow = true;
  return start;
}

Span SpanWalker::start(const TriangleSetup& setup, const RowSpan& row, bool& overflow) const {
  Span span;
  span.row = row;
  span.triangle = setup.triangle;
  span.material = setup.material;
  for (std::size_t c = 0; c < static_cast<std::size_t>(configuration_.channels); ++c) {
    span.diffuse[c] = start_series(setup.diffuse[c], setup, row, diffuse_limit_, overflow);
  }
  if (configuration_.gate == GateSource::series) {
    span.gate = start_series(setup.gate, setup, row, diffuse_limit_, overflow);
  }
  span.specular =
      start_series(setup.specular, setup, row, specular_limit_, overflow);
  span.depth = wrap_add(setup.depth, wrap_add(wrap_mul(setup.depth_x, row.x - setup.x),
                                              wrap_mul(setup.depth_y, row.y - setup.y)));
  span.depth_step = setup.depth_x;
  return span;
}

}  // namespace phongpipe
