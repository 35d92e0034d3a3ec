// Generated from model/fixed by scripts/generate.sh; do not edit.
`define PHONGPIPE_OUTPUT_BITS 8
`define PHONGPIPE_GUARD_BITS 1
`define PHONGPIPE_COORDINATE_BITS 12
`define PHONGPIPE_LENGTH_BITS 13
`define PHONGPIPE_CUE_WIDTH 32
`define PHONGPIPE_CUE_FRACTION 20
`define PHONGPIPE_CUE_FACTOR_BITS 10
`define PHONGPIPE_GATE_OFF 0
`define PHONGPIPE_GATE_DIFFUSE 1
`define PHONGPIPE_GATE_SERIES 2
`define PHONGPIPE_LAYOUT_PLAIN 0
`define PHONGPIPE_LAYOUT_OCTAVE 1
`define PHONGPIPE_LAYOUT_BIPARTITE 2
`define PHONGPIPE_SPECULAR_GUARD_BITS 12
`define PHONGPIPE_DATAPATH_LATENCY 4
`define PHONGPIPE_DEPTH_CUE_LATENCY 1
`define PHONGPIPE_CHECK_PARAMETERS \
  if (DIFFUSE_FRACTION < 4 || DIFFUSE_FRACTION > 30) begin : DIFFUSE_FRACTION_out_of_range \
    DIFFUSE_FRACTION_must_be_4_to_30 stop (); end \
  if (SPECULAR_FRACTION < 1 || SPECULAR_FRACTION > 25) begin : SPECULAR_FRACTION_out_of_range \
    SPECULAR_FRACTION_must_be_1_to_25 stop (); end \
  if (ROM_ADDRESS_BITS < 6 || ROM_ADDRESS_BITS > 13) begin : ROM_ADDRESS_BITS_out_of_range \
    ROM_ADDRESS_BITS_must_be_6_to_13 stop (); end \
  if (ROM_OCTAVES < 1 || ROM_OCTAVES > 4) begin : ROM_OCTAVES_out_of_range \
    ROM_OCTAVES_must_be_1_to_4 stop (); end \
  if (ROM_DATA_BITS < 4 || ROM_DATA_BITS > 12) begin : ROM_DATA_BITS_out_of_range \
    ROM_DATA_BITS_must_be_4_to_12 stop (); end
