// A technology card: the clock period of the pixel datapath, by its width, table size and effects.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

struct Technology {
  struct Point {
    int width = 0;         // bits of the widest series
    int address_bits = 0;  // of the ROM
    double clock_ns = 0;
  };
  std::string name;
  std::string source;         // where the figures come from
  std::vector<Point> points;  // sorted by width; empty if the clock is fixed
  double fixed_clock_ns = 0;
  // Least clock period with the multiplier of depth cueing; with `points` only.
  double depth_cue_clock_ns = 0;

  // The clock period of the narrowest point that is wide enough. A larger table adds the difference
  // measured at a width that has both table sizes. Throws InputError if no point is large enough.
  double clock_ns(const DatapathConfiguration& configuration) const;
};

// Loads a card from a file, or by its name. Throws InputError.
Technology load_technology(const std::string& name);

}  // namespace phongpipe
