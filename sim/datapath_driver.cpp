#include "sim/datapath_driver.h"

#include <fmt/format.h>

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
  const bool busy = inputs.span != nullptr || pixels_in_flight_ > 0;
  if (busy) ++busy_clocks_;
  const DatapathOutputs outputs = datapath_->clock(inputs);
  if (inputs.span != nullptr && outputs.span_ready) {
    outcome.span_taken = true;
    pixels_in_flight_ += span->row.length;
    pixels_ += span->row.length;
  }
  if (outputs.pixel_valid && pixel_ready) {
    outcome.pixel_taken = true;
    outcome.outputs = outputs;
    if (pixels_in_flight_ < outputs.pixels()) ++unasked_pixels_;
    pixels_in_flight_ -= outputs.pixels();
  }
  outcome.pixel_held = outputs.pixel_valid && !pixel_ready;
  if (busy && pixel_ready && !outcome.span_taken && !outcome.pixel_taken) ++idle_clocks_;
  return outcome;
}

std::string DatapathDriver::in_flight_text() const {
  return pixels_in_flight_ < 0
             ? fmt::format("{} pixels more from pixel_datapath than spans have", -pixels_in_flight_)
             : fmt::format("{} pixels in pixel_datapath", pixels_in_flight_);
}

std::string DatapathDriver::misbehaviour(std::int64_t patience_clocks) const {
  if (unasked_pixels_ > kUnaskedPixels) {
    return fmt::format("pixel_datapath has emitted {} pixels that no span asked for",
                       unasked_pixels_);
  }
  const std::int64_t for_each_pixel = frame_->configuration.latency_cycles() + kIdleClocks;
  if (idle_clocks_ > 2 * patience_clocks + for_each_pixel * pixels_) {
    return fmt::format(
        "pixel_datapath was idle in {} clocks with work at hand and its output free, over {} "
        "pixels",
        idle_clocks_, pixels_);
  }
  return {};
}

}  // namespace phongpipe
