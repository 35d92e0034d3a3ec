// The values that the series' registers of a frame take on, known before a pixel is stepped: which
// width they need, and whether the configuration's is enough.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "model/fixed/frame_setup.h"

namespace phongpipe {

// Of one register over all pixels of a frame, in units of its last bit, not wrapped.
struct RegisterRange {
  double low = 0, high = 0;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Bits of a two's-complement register that holds the range.
  int width() const;
};

struct SeriesRanges {
  std::string_view name;  // "diffuse", "gate", "specular", "cue"
  int width = 0;          // of its registers, in bits
  RegisterRange v, d1, d2;

  // Differences may wrap: as long as v fits, it is right.
  int needed_width() const { return v.width(); }
  bool fits() const { return needed_width() <= width; }
};

// The series of the configuration; those of all channels together. v, d1 and d2 are exact integers
// below 2^53, beyond which they are rounded.
std::vector<SeriesRanges> register_ranges(const FrameSetup& frame);

}  // namespace phongpipe
