// One RTL in place of many: the datapath of a configuration runs, bit by bit and clock by clock, in
// RTL of the same blocks with wider registers and a larger table; in the octave layouts with the
// same table. Series are shifted left until their top bits meet, for the datapath uses only top
// bits; each word of the table is written to all addresses that share its leading bits.
#pragma once

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// How the words of a configuration lie in wider RTL: all shifts to the left, in bits. Zero: as they
// are.
struct RtlAlignment {
  int diffuse = 0;   // diffuse and gate series, and level
  int specular = 0;  // specular series
  int address = 0;   // of the table
};

// The same blocks and words of the table, with the widest series and the largest table. A serial
// datapath is its own superset, for it takes a clock more for each digit that its registers are
// wider.
DatapathConfiguration superset_of(const DatapathConfiguration& configuration);

// Of `configuration` in the RTL of superset_of(configuration).
RtlAlignment superset_alignment(const DatapathConfiguration& configuration);

}  // namespace phongpipe
