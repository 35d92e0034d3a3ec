// One channel's light: sum = (max(diffuse, level) + (open ? word + increment : 0)) >> fraction, and
// color = min(255, sum).
//
// diffuse and level are s(1 + GUARD_BITS + OUTPUT_BITS).(fraction); level holds ambient light and the
// rounding half, is not negative, and a series at or below it is unlit. word and increment are full scale /
// 2^WORD_BITS a unit, and wrap. One sum a clock; clocks from the diffuse value: the low bits are compared, 1;
// lit, 2; clamped, 3; the word, whose inputs and `open` arrive at 4, is added up, 5; sum, 6. color follows
// sum without a clock.
`include "constants.svh"

module color_sum #(
    parameter int DIFFUSE_WIDTH = 26,
    parameter int WORD_BITS     = 8,
    // What the words have below one output LSB is all the fraction that can reach the output.
    localparam int SUM_FRACTION =
        WORD_BITS > `PHONGPIPE_OUTPUT_BITS ? WORD_BITS - `PHONGPIPE_OUTPUT_BITS : 0,
    localparam int OUT_BITS     = `PHONGPIPE_GUARD_BITS + `PHONGPIPE_OUTPUT_BITS + 1
) (
    input  logic                              clk,
    input  logic [         DIFFUSE_WIDTH-1:0] s4_diffuse,
    input  logic [         DIFFUSE_WIDTH-1:0] s3_level,
    output logic                              s6_lit,
    input  logic                              s8_open,
    input  logic [             WORD_BITS-1:0] s8_word,
    input  logic [             WORD_BITS-1:0] s8_increment,
    output logic [              OUT_BITS-1:0] s10_sum,
    output logic [`PHONGPIPE_OUTPUT_BITS-1:0] s10_color
);
  localparam int WORD_SHIFT = WORD_BITS < `PHONGPIPE_OUTPUT_BITS ? `PHONGPIPE_OUTPUT_BITS - WORD_BITS : 0;
  localparam int CUT_BITS = `PHONGPIPE_GUARD_BITS + `PHONGPIPE_OUTPUT_BITS + SUM_FRACTION;  // without the sign
  localparam int SUM_BITS = CUT_BITS + 1;
  localparam int DROPPED = DIFFUSE_WIDTH - 1 - CUT_BITS;
  localparam int HIGH_BITS = `PHONGPIPE_HIGH_BITS;
  localparam int LOW_BITS = DIFFUSE_WIDTH > HIGH_BITS ? DIFFUSE_WIDTH - HIGH_BITS : 1;

  // Complements, so that diffuse > level is the carry of diffuse + ~level.
  logic [DIFFUSE_WIDTH-2:0] s4_level_complement;
  logic [DIFFUSE_WIDTH-2:LOW_BITS] s5_level_complement;
  logic [DIFFUSE_WIDTH-1:LOW_BITS] s5_diffuse;
  logic s5_low_above;
  logic [CUT_BITS-1:0] s5_diffuse_cut, s5_level_cut, s6_diffuse_cut, s6_level_cut;
  logic [CUT_BITS-1:0] s7_clamped, s8_clamped, s9_clamped;
  logic [WORD_BITS-1:0] s9_addend;

  wire [LOW_BITS:0] low_difference = {1'b0, s4_diffuse[LOW_BITS-1:0]} + {1'b0, s4_level_complement[LOW_BITS-1:0]};
  wire [DIFFUSE_WIDTH-LOW_BITS:0] high_difference =
      {1'b0, s5_diffuse[DIFFUSE_WIDTH-2:LOW_BITS], 1'b1} + {1'b0, s5_level_complement, s5_low_above};
  wire [SUM_BITS-1:0] whole = {1'b0, s9_clamped}
                            + {{(SUM_BITS - WORD_BITS - WORD_SHIFT) {1'b0}}, s9_addend, {WORD_SHIFT{1'b0}}};
  wire unused_fraction = &{1'b0, whole, s3_level, low_difference, high_difference};  // the bits below the output's LSB

  wire overflow = |s10_sum[OUT_BITS-1:`PHONGPIPE_OUTPUT_BITS];
  assign s10_color = overflow ? '1 : s10_sum[`PHONGPIPE_OUTPUT_BITS-1:0];

  always_ff @(posedge clk) begin
    s4_level_complement <= ~s3_level[DIFFUSE_WIDTH-2:0];

    s5_low_above <= low_difference[LOW_BITS] & ~s4_diffuse[DIFFUSE_WIDTH-1];
    s5_diffuse <= s4_diffuse[DIFFUSE_WIDTH-1:LOW_BITS];
    s5_level_complement <= s4_level_complement[DIFFUSE_WIDTH-2:LOW_BITS];
    s5_diffuse_cut <= s4_diffuse[DROPPED+:CUT_BITS];
    s5_level_cut <= ~s4_level_complement[DROPPED+:CUT_BITS];

    s6_lit <= !s5_diffuse[DIFFUSE_WIDTH-1] && high_difference[DIFFUSE_WIDTH-LOW_BITS];
    s6_diffuse_cut <= s5_diffuse_cut;
    s6_level_cut <= s5_level_cut;

    s7_clamped <= s6_lit ? s6_diffuse_cut : s6_level_cut;
    s8_clamped <= s7_clamped;
    s9_clamped <= s8_clamped;
    s9_addend <= s8_open ? s8_word + s8_increment : '0;
    s10_sum <= whole[SUM_BITS-1:SUM_FRACTION];
  end
endmodule
