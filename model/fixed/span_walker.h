// span_walker: computes the start of each span, one per covered row, from a triangle's
// coefficients.
#pragma once

#include "model/fixed/coverage.h"
#include "model/fixed/setup_engine.h"

namespace phongpipe {

class SpanWalker {
 public:
  explicit SpanWalker(const FrameSetup& frame);

  // v, Δ and ΔΔ at the first pixel of the row, evaluated exactly from the rounded T_i and, with
  // Anchor::span, rounded to the datapath's fraction.
  void start(const TriangleSetup& setup, const RowSpan& row, Span& span) const;
  Span start(const TriangleSetup& setup, const RowSpan& row) const {
    Span span;
    start(setup, row, span);
    return span;
  }

  // Whether the values of all pixels of the row fit their registers. If not, the datapath wraps to
  // a wrong colour.
  bool fits(const TriangleSetup& setup, const RowSpan& row) const;

 private:
  void start_exact(const TriangleSetup& setup, const RowSpan& row, Span& span) const;
  void start_series(const FixedQuadratic& t, int x, int y, SeriesStart& start) const;
  bool series_fits(const FixedQuadratic& t, int x, int y, int length, double limit) const;

  FrameConfiguration configuration_;
  int dropped_bits_;                                   // fraction bits, between setup and datapath
  double diffuse_limit_, specular_limit_, cue_limit_;  // largest values of the registers
};

}  // namespace phongpipe
