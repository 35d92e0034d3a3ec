// The ports of pixel_datapath, clock by clock. The SystemC pipeline drives them; behind them are
// the model's values or the Verilated RTL.
#pragma once

#include <array>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

struct DatapathInputs {
  const Span* span = nullptr;  // span_valid if not null; held until span_ready
  bool pixel_ready = false;
  const HighlightTable* table = nullptr;  // rom_write if not null: one word per channel,
  int rom_address = 0;                    // at this address
};

struct DatapathOutputs {
  bool span_ready = false;
  bool pixel_valid = false;
  ShadedPixel pixel;
  // Of a wide datapath: the pixels beside it, which leave in the same clock.
  int others = 0;
  std::array<ShadedPixel, kMostLanes - 1> other{};

  // Bit k: whether there is a pixel k side by side.
  int valid_bits() const { return pixel_valid ? (1 << pixels()) - 1 : 0; }
  // Of a valid pixel and those beside it.
  int pixels() const { return 1 + others; }
  const ShadedPixel& operator[](int i) const {
    return i == 0 ? pixel : other[static_cast<std::size_t>(i) - 1];
  }
};

class ClockedDatapath {
 public:
  virtual ~ClockedDatapath() = default;
  // Synchronous reset, one clock; the table keeps its words.
  virtual void reset() = 0;
  // Executes one clock with these inputs; returns the outputs as they stand before its edge.
  virtual DatapathOutputs clock(const DatapathInputs& inputs) = 0;
};

}  // namespace phongpipe
