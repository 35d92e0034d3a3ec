// Drives the ports of pixel_datapath: presents spans and, before a span with a new highlight table,
// lets the datapath run empty and loads the table, one word a clock.
#pragma once

#include <string>

#include "sim/clocked_datapath.h"

namespace phongpipe {

class DatapathDriver {
 public:
  DatapathDriver(const FrameSetup& frame, ClockedDatapath& datapath);

  struct Outcome {
    bool span_taken = false;
    bool pixel_taken = false;  // of the outputs, with those beside it
    DatapathOutputs outputs;
    bool pixel_held = false;  // it is valid, but there is no room for it
    bool loading = false;     // a word of a table was written
  };
  // Executes one clock. `span`: the front of the queue, or null; it stays the same until it is
  // taken.
  Outcome clock(const Span* span, bool pixel_ready);

  std::int64_t pixels_in_flight() const { return pixels_in_flight_; }
  // "12 pixels in pixel_datapath", or how many it emitted too many.
  std::string in_flight_text() const;
  // Clocks in which the datapath held a pixel or was offered a span.
  std::int64_t busy_clocks() const { return busy_clocks_; }

  // Why the simulation should stop; empty if it should not. Either the datapath has emitted more
  // than kUnaskedPixels pixels that belong to no span, or it has been idle, with work pending and
  // its output free, in more than 2 · `patience_clocks` + (latency + kIdleClocks) · (pixels of all
  // spans taken) clocks.
  std::string misbehaviour(std::int64_t patience_clocks) const;

 private:
  static constexpr std::int64_t kUnaskedPixels = 1000;
  static constexpr std::int64_t kIdleClocks = 3;
  static constexpr std::uint32_t kNoTable = ~std::uint32_t{0};

  const FrameSetup* frame_;
  ClockedDatapath* datapath_;
  std::uint32_t loaded_ = kNoTable;
  int next_word_ = 0;
  std::int64_t pixels_in_flight_ = 0;
  std::int64_t busy_clocks_ = 0;
  std::int64_t idle_clocks_ = 0;  // with work pending and a free output
  std::int64_t pixels_ = 0;       // of all spans taken
  std::int64_t unasked_pixels_ = 0;
};

}  // namespace phongpipe
