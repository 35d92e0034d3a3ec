#include "model/fixed/span_walker.h"

#include <cmath>

namespace phongpipe {
namespace {

// Whether every value v + d1 i + d2 i(i−1)/2, 0 ≤ i < length, lies within ±limit. Computed in
// double, which is exact enough for a bound and does not wrap.
bool within(double v, double d1, double d2, int length, double limit) {
  const auto fits = [&](double i) { return std::fabs(v + i * (d1 + 0.5 * d2 * (i - 1))) <= limit; };
  if (!fits(0) || !fits(length - 1)) return false;
  const double vertex = 0.5 - d1 / d2;
  if (!(vertex > 0 && vertex < length - 1)) return true;  // nor for d2 = 0
  return fits(std::floor(vertex)) && fits(std::ceil(vertex));
}

}  // namespace

SpanWalker::SpanWalker(const FrameSetup& frame)
    : configuration_(frame.configuration),
      dropped_bits_(setup_fraction_bits(frame.configuration, 0)),
      diffuse_limit_(std::ldexp(1.0, configuration_.diffuse_width() - 1) - 1),
      specular_limit_(std::ldexp(1.0, configuration_.specular_width() - 1) - 1),
      cue_limit_(std::ldexp(1.0, kCueWidth - 1) - 1) {}

void SpanWalker::start_series(const FixedQuadratic& t, int x, int y, SeriesStart& start) const {
  start.v = round_off(t.value(x, y), dropped_bits_);
  start.d1 = round_off(t.difference(x, y), dropped_bits_);
  start.d2 = round_off(wrap_mul(2, t.t5), dropped_bits_);
}

bool SpanWalker::series_fits(const FixedQuadratic& t, int x, int y, int length,
                             double limit) const {
  const auto real = [](std::int64_t value) { return static_cast<double>(value); };
  // A start that wrapped beyond 64 bits can not be told from one that fits, but by its real value.
  const double v = (real(t.t5) * x + real(t.t4) * y + real(t.t2)) * x +
                   (real(t.t3) * y + real(t.t1)) * y + real(t.t0);
  const double d1 = real(t.t5) * (2 * x + 1) + real(t.t4) * y + real(t.t2);
  constexpr double kLargest = 0x1p62;
  if (std::fabs(v) > kLargest || (length > 1 && std::fabs(d1) > kLargest)) return false;
  SeriesStart start;
  start_series(t, x, y, start);
  return within(real(start.v), real(start.d1), real(start.d2), length, limit);
}

void SpanWalker::start(const TriangleSetup& setup, const RowSpan& row, Span& span) const {
  const int x = row.x - setup.x, y = row.y - setup.y;
  const SeriesPlan& plan = setup.plan;
  if (row.is_exact()) {
    start_exact(setup, row, span);
    return;
  }
  span.row = row;
  span.triangle = setup.triangle;
  span.table = setup.material->table;
  span.first_pass = setup.pass == 0;
  span.step_diffuse = row.lit && plan.light() == SeriesForm::fitted;
  span.step_specular = row.lit && plan.specular == SeriesForm::fitted;
  span.highlight = row.lit && is_present(plan.specular);
  span.level = setup.material->level;
  const auto start_or_clear = [&](bool used, const FixedQuadratic& t, SeriesStart& start) {
    if (used) {
      start_series(t, x, y, start);
    } else {
      start = SeriesStart();
    }
  };
  start_or_clear(span.highlight, setup.specular, span.specular);
  for (int c = 0; c < 3; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    SeriesStart& diffuse = span.diffuse[channel];
    start_or_clear(row.lit && c < configuration_.channels, setup.diffuse[channel], diffuse);
    if (!row.lit) diffuse.v = span.level[channel];
  }
  start_or_clear(row.lit && is_present(plan.gate), setup.gate, span.gate);
  const FixedLinear& factor = setup.cue_factor;
  start_or_clear(plan.depth_cue, {factor.c, factor.b, factor.a, 0, 0, 0}, span.cue);
  span.depth = plan.depth ? setup.depth.value(x, y) : 0;
  span.depth_step = plan.depth ? setup.depth.a : 0;
}

// The datapath adds nothing to the colour of exact_path, and fades it no further.
void SpanWalker::start_exact(const TriangleSetup& setup, const RowSpan& row, Span& span) const {
  span = Span();
  span.row = row;
  span.triangle = setup.triangle;
  span.table = setup.material->table;
  span.first_pass = true;
  span.step_diffuse = span.step_specular = span.highlight = false;
  const auto& values = setup.exact_values[static_cast<std::size_t>(row.exact)];
  for (std::size_t c = 0; c < values.size(); ++c) span.diffuse[c].v = values[c];
  if (configuration_.depth_cue) span.cue.v = std::int64_t{1} << kCueFraction;
  if (setup.plan.depth) {
    span.depth = setup.depth.value(row.x - setup.x, row.y - setup.y);
    span.depth_step = setup.depth.a;
  }
}

bool SpanWalker::fits(const TriangleSetup& setup, const RowSpan& row) const {
  if (row.is_exact()) return true;
  const int x = row.x - setup.x, y = row.y - setup.y;
  const FixedLinear& share = setup.cue_factor;
  if (setup.plan.depth_cue &&
      !series_fits({share.c, share.b, share.a, 0, 0, 0}, x, y, row.length, cue_limit_)) {
    return false;
  }
  if (!row.lit) return true;
  for (std::size_t c = 0; c < static_cast<std::size_t>(configuration_.channels); ++c) {
    if (!series_fits(setup.diffuse[c], x, y, row.length, diffuse_limit_)) return false;
  }
  return (!is_present(setup.plan.gate) ||
          series_fits(setup.gate, x, y, row.length, diffuse_limit_)) &&
         (!is_present(setup.plan.specular) ||
          series_fits(setup.specular, x, y, row.length, specular_limit_));
}

}  // namespace phongpipe
