// span_walker: from a triangle's coefficients to the starts of its spans, one a covered row.
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

  // False where the value of some pixel of the row does not fit its register, so that the datapath
  // would wrap to a wrong colour.
  bool fits(const TriangleSetup& setup, const RowSpan& row) const;

 private:
  void start_series(const FixedQuadratic& t, int x, int y, SeriesStart& start) const;
  bool series_fits(const FixedQuadratic& t, int x, int y, int length, double limit) const;

  FrameConfiguration configuration_;
  int dropped_bits_;                                   // between setup and datapath
  double diffuse_limit_, specular_limit_, cue_limit_;  // largest values of the registers
};

}  // namespace phongpipe
