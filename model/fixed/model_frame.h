// A whole frame by the bit-accurate model: the reference for every pixel.
#pragma once

#include <functional>
#include <vector>

#include "model/fixed/framebuffer.h"
#include "model/fixed/front_end.h"
#include "model/fixed/pixel_datapath.h"
#include "model/fixed/shading_path.h"

namespace phongpipe {

// Counts of a frame's triangles by outcome.
struct TriangleCounts {
  std::size_t set_up = 0;     // that cover a pixel, once per light that reaches them
  std::size_t left_out = 0;   // of these, that add nothing to their pixels
  std::size_t overflows = 0;  // with a coefficient or value beyond its register
};

// The spans of a frame with the colours of their pixels, in the order of the pipeline, before the
// depth test.
class SpanStream {
 public:
  explicit SpanStream(const FrameSetup& frame, Evaluation evaluation = best_evaluation());

  // Advances to the next span; false at the end.
  bool next();
  const Span& span() const { return spans_[current_]; }
  // The colour of each pixel of the span.
  const std::uint32_t* colors() const { return colors_.data() + first_color_; }
  const TriangleCounts& triangles() const { return triangles_; }
  const Ledger& ledger() const { return ledger_; }

 private:
  bool next_batch();
  bool next_triangle();

  const FrameSetup& frame_;
  FrontEnd front_end_;
  TriangleOrder order_;
  PixelDatapath datapath_;
  std::uint32_t loaded_table_ = ~std::uint32_t{0};
  TriangleWork work_;
  std::size_t next_row_ = 0;
  std::vector<Span> spans_;  // of the batch
  std::vector<std::uint32_t> colors_;
  std::size_t current_ = 0, first_color_ = 0;
  TriangleCounts triangles_;
  Ledger ledger_;
};

struct ModelFrame {
  Framebuffer framebuffer;  // with owners
  TriangleCounts triangles;
  std::uint64_t pixels = 0;  // shaded
  Ledger ledger;             // of these, by how they are shaded

  // Channel 0 in the low byte.
  std::vector<std::uint32_t> colors() const;
};

// Called for each span with the colours of its pixels.
using ObserveSpan = std::function<void(const Span& span, const std::uint32_t* colors)>;
ModelFrame run_model(const FrameSetup& frame, const ObserveSpan& observe = {},
                     Evaluation evaluation = best_evaluation());

}  // namespace phongpipe
