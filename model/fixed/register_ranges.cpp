#include "model/fixed/register_ranges.h"

#include <cmath>

#include "model/fixed/front_end.h"

namespace phongpipe {
namespace {

// v(i) = v + d1 i + d2 i(i−1)/2 and its difference over a span.
void include_span(const SeriesStart& start, int length, SeriesRanges& ranges) {
  const auto v = static_cast<double>(start.v), d1 = static_cast<double>(start.d1),
             d2 = static_cast<double>(start.d2);
  const double last = length - 1;
  const auto include = [&](double i) { ranges.v.include(v + d1 * i + d2 * i * (i - 1) / 2); };
  include(0);
  include(last);
  // The pixels on both sides of the parabola's vertex.
  const double vertex = d2 == 0 ? 0 : 0.5 - d1 / d2;
  for (const double i : {std::floor(vertex), std::ceil(vertex)}) {
    if (i > 0 && i < last) include(i);
  }
  ranges.d1.include(d1);
  ranges.d1.include(d1 + d2 * last);
  ranges.d2.include(d2);
}

}  // namespace

int RegisterRange::width() const {
  int bits = 1;
  while (low < -std::ldexp(1, bits - 1) || high >= std::ldexp(1, bits - 1)) ++bits;
  return bits;
}

std::vector<SeriesRanges> register_ranges(const FrameSetup& frame) {
  const FrameConfiguration& f = frame.configuration;
  SeriesRanges diffuse{"diffuse", f.diffuse_width(), {}, {}, {}};
  SeriesRanges gate{"gate", f.diffuse_width(), {}, {}, {}};
  SeriesRanges specular{"specular", f.specular_width(), {}, {}, {}};
  SeriesRanges cue{"cue", kCueWidth, {}, {}, {}};
  const FrontEnd front_end(frame);
  TriangleWork work;
  for (TriangleOrder next(front_end); !next.done(); next.advance()) {
    if (front_end.set_up(next.triangle(), next.pass(), work) != SetupOutcome::ready) continue;
    for (const RowSpan& row : work.rows) {
      const Span span = front_end.span_walker().start(work.setup, row);
      for (int c = 0; c < f.channels; ++c) {
        include_span(span.diffuse[static_cast<std::size_t>(c)], row.length, diffuse);
      }
      include_span(span.gate, row.length, gate);
      include_span(span.specular, row.length, specular);
      include_span(span.cue, row.length, cue);
    }
  }
  std::vector<SeriesRanges> ranges;
  if (f.diffuse) ranges.push_back(diffuse);
  if (f.has_gate_series()) ranges.push_back(gate);
  if (f.specular) ranges.push_back(specular);
  if (f.depth_cue) ranges.push_back(cue);
  return ranges;
}

}  // namespace phongpipe
