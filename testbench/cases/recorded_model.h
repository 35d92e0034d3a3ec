// The model's frame with all its pixels and spans recorded, for tests that check them one by one.
#pragma once

#include <vector>

#include "model/fixed/model_frame.h"

namespace phongpipe {

struct RecordedSpan {
  RowSpan row;
  std::uint32_t triangle = 0;
};

struct RecordedModel : ModelFrame {
  std::vector<ShadedPixel> stream;  // every shaded pixel, in order, before the depth test
  std::vector<RecordedSpan> spans;  // the spans of these pixels, in order
};

inline RecordedModel record_model(const FrameSetup& frame,
                                  Evaluation evaluation = best_evaluation()) {
  std::vector<ShadedPixel> stream;
  std::vector<RecordedSpan> spans;
  ModelFrame model = run_model(
      frame,
      [&](const Span& span, const std::uint32_t* colors) {
        spans.push_back({span.row, span.triangle});
        for (int i = 0; i < span.row.length; ++i) {
          stream.push_back({static_cast<std::uint16_t>(span.row.x + i),
                            static_cast<std::uint16_t>(span.row.y), colors[i]});
        }
      },
      evaluation);
  return {std::move(model), std::move(stream), std::move(spans)};
}

}  // namespace phongpipe
