#include "sim/datapath_driver.h"

namespace phongpipe {

DatapathDriver::DatapathDriver(const FrameSetup& frame, ClockedDatapath& datapath)
    : frame_(&frame), datapath_(&datapath) {}

DatapathDriver::Outcome DatapathDriver::clock(const Span* span, bool pixel_ready) {
  DatapathInputs inputs;
  inputs.pixel_ready = pixel_ready;
  Outcome outcome;
  if (span != nullptr) {
    if (!span->highlight || span->table == loaded_) {
      inputs.span = span;
    } else if (pixels_in_flight_ == 0) {
      outcome.loading = true;
      inputs.table = &frame_->tables[span->table];
      inputs.rom_address = next_word_++;
      if (next_word_ == frame_->configuration.rom_words()) {
        loaded_ = span->table;
        next_word_ = 0;
      }
    }
  }
  if (inputs.span != nullptr || pixels_in_flight_ > 0) ++busy_clocks_;
  const DatapathOutputs outputs = datapath_->clock(inputs);
  if (inputs.span != nullptr && outputs.span_ready) {
    outcome.span_taken = true;
    pixels_in_flight_ += span->row.length;
  }
  if (outputs.pixel_valid && pixel_ready) {
    outcome.pixel_taken = true;
    outcome.pixel = outputs.pixel;
    --pixels_in_flight_;
  }
  return outcome;
}

}  // namespace phongpipe
