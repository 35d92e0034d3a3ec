// What stands before the ports of pixel_datapath: presents spans, and for a highlight of another
// table lets the datapath run empty and loads it, one word a clock.
#pragma once

#include <string>

#include "sim/clocked_datapath.h"

namespace phongpipe {

class DatapathDriver {
 public:
  DatapathDriver(const FrameSetup& frame, ClockedDatapath& datapath);

  struct Outcome {
    bool span_taken = false;
    bool pixel_taken = false;
    ShadedPixel pixel;
    bool loading = false;  // a word was written
  };
  // One clock. `span`: the front of the queue, or null; the same one until it is taken.
  Outcome clock(const Span* span, bool pixel_ready);

  std::int64_t pixels_in_flight() const { return pixels_in_flight_; }
  // Clocks in which the datapath held a pixel or was offered a span.
  std::int64_t busy_clocks() const { return busy_clocks_; }

  // Why there is no use in going on, or an empty text: the datapath emits pixels that no span asked
  // for, or has done nothing, with work at hand and its output free, in more clocks than twice
  // `patience_clocks` and kIdleClocks for each pixel.
  std::string misbehaviour(std::int64_t patience_clocks) const;

 private:
  static constexpr std::int64_t kUnaskedPixels = 1000;
  static constexpr std::int64_t kIdleClocks = 16;  // more than its latency
  static constexpr std::uint32_t kNoTable = ~std::uint32_t{0};

  const FrameSetup* frame_;
  ClockedDatapath* datapath_;
  std::uint32_t loaded_ = kNoTable;
  int next_word_ = 0;
  std::int64_t pixels_in_flight_ = 0;
  std::int64_t busy_clocks_ = 0;
  std::int64_t idle_clocks_ = 0;  // with work at hand and a free output
  std::int64_t pixels_ = 0;       // asked for so far
  std::int64_t unasked_pixels_ = 0;
};

}  // namespace phongpipe
