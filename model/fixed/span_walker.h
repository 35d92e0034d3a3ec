// span_walker: from a triangle's coefficients to the starts of its spans, one a covered row.
#pragma once

#include "model/fixed/coverage.h"
#include "model/fixed/setup_engine.h"

namespace phongpipe {

class SpanWalker {
 public:
  explicit SpanWalker(const FrameSetup& frame);

  // v, Δ and ΔΔ at the first pixel of the row, evaluated exactly from the rounded T_i and, with
  // Anchor::span, rounded to the datapath's fraction. Sets `overflow` where a value of some pixel of
  // the row does not fit its register, so that the datapath would wrap to a wrong colour.
  Span start(const TriangleSetup& setup, const RowSpan& row, bool& overflow) const;

 private:
  SeriesStart start_series(const FixedQuadratic& t, const TriangleSetup& setup, const RowSpan& row,
                           double limit, bool& overflow) const;

  DatapathConfiguration configuration_;
  int dropped_bits_;  // between setup and datapath
  double unit_;       // of the datapath, in units of the setup
  double diffuse_limit_, specular_limit_;  // largest values of the registers
};

}  // namespace phongpipe
