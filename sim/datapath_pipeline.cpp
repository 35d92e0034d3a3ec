#include "sim/datapath_pipeline.h"

#include <algorithm>

namespace phongpipe {

DatapathPipeline::DatapathPipeline(const DatapathConfiguration& configuration,
                                   const OutputColor& cue_color)
    : values_(configuration, best_evaluation(), cue_color),
      last_address_(configuration.rom_words() - 1),
      stages_(static_cast<std::size_t>(configuration.latency_cycles() - 1)) {}

void DatapathPipeline::reset() {
  row_ = {};
  next_ = 0;
  std::fill(stages_.begin(), stages_.end(), Stage{});
}

void DatapathPipeline::accept(const Span& span) {
  row_ = span.row;
  next_ = 0;
  colors_.resize(std::max(colors_.size(), PixelDatapath::padded(row_.length)));
  values_.shade(span, colors_.data());
}

DatapathOutputs DatapathPipeline::clock(const DatapathInputs& inputs) {
  DatapathOutputs outputs;
  outputs.pixel_valid = stages_.back().valid;
  outputs.pixel = stages_.back().pixel;

  bool ready = inputs.pixel_ready;  // of what follows the stage
  for (std::size_t i = stages_.size(); i-- > 0;) {
    ready = ready || !stages_[i].valid;
    if (!ready) continue;
    if (i > 0) {
      stages_[i] = stages_[i - 1];
      continue;
    }
    stages_[0].valid = next_ < row_.length;
    if (!stages_[0].valid) continue;
    stages_[0].pixel = {static_cast<std::uint16_t>(row_.x + next_),
                        static_cast<std::uint16_t>(row_.y),
                        colors_[static_cast<std::size_t>(next_)]};
    ++next_;
  }
  // The first stage is free when its last pixel has just moved on.
  outputs.span_ready = next_ >= row_.length;
  if (inputs.table != nullptr && inputs.rom_address == last_address_) {
    values_.load_table(*inputs.table);
  }
  if (inputs.span != nullptr && outputs.span_ready) accept(*inputs.span);
  return outputs;
}

}  // namespace phongpipe
