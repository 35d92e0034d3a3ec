// A technology card: how long a clock of the pixel datapath is, by its width, table size and
// effects.
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
  std::vector<Point> points;  // by width; empty where the clock is fixed
  double fixed_clock_ns = 0;
  double depth_cue_clock_ns =
      0;  // the least clock with the multiplier of depth cueing, where points are

  // The clock of the next wider point; a larger table adds what it adds at the width where both
  // sizes were measured.
  double clock_ns(const DatapathConfiguration& configuration) const;
};

// By file, or by the name of a card. Throws InputError.
Technology load_technology(const std::string& name);

}  // namespace phongpipe
