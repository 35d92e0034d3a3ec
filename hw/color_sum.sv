// One channel's light: sum = (max(diffuse, level) + (highlight_open ? word : 0)) >> fraction, and
// color = min(255, sum).
//
// diffuse and level are s(1 + GUARD_BITS + OUTPUT_BITS).(fraction); level holds ambient light and the
// rounding half, is not negative, and a series at or below it is unlit. word is full scale /
// 2^WORD_BITS a unit. Latency 3: compare under enable 0, clamp under enable 1, where the word arrives
// and highlight_open is due with it, add under enable 2. color follows sum without a clock.
`include "constants.svh"

module color_sum #(
    parameter int DIFFUSE_WIDTH = 26,
    parameter int WORD_BITS     = 8,
    // What the words have below one output LSB is all the fraction that can reach the output.
    localparam int SUM_FRACTION =
        WORD_BITS > `PHONGPIPE_OUTPUT_BITS ? WORD_BITS - `PHONGPIPE_OUTPUT_BITS : 0,
    localparam int OUT_BITS     = `PHONGPIPE_GUARD_BITS + `PHONGPIPE_OUTPUT_BITS + 1
) (
    input  logic                                     clk,
    input  logic [                              2:0] enable,
    input  logic [                DIFFUSE_WIDTH-1:0] diffuse,
    input  logic [                DIFFUSE_WIDTH-1:0] level,
    output logic                                     lit,
    input  logic                                     highlight_open,
    input  logic [                    WORD_BITS-1:0] word,
    output logic [                     OUT_BITS-1:0] sum,
    output logic [`PHONGPIPE_OUTPUT_BITS-1:0] color
);
  localparam int WORD_SHIFT = WORD_BITS < `PHONGPIPE_OUTPUT_BITS ? `PHONGPIPE_OUTPUT_BITS - WORD_BITS : 0;
  localparam int CUT_BITS = `PHONGPIPE_GUARD_BITS + `PHONGPIPE_OUTPUT_BITS + SUM_FRACTION;  // without the sign
  localparam int SUM_BITS = CUT_BITS + 1;
  localparam int DROPPED = DIFFUSE_WIDTH - 1 - CUT_BITS;

  logic [CUT_BITS-1:0] diffuse_cut;
  logic [CUT_BITS-1:0] level_cut;
  logic [CUT_BITS-1:0] clamped;

  wire [SUM_BITS-1:0] addend =
      highlight_open ? {{(SUM_BITS - WORD_BITS - WORD_SHIFT) {1'b0}}, word, {WORD_SHIFT{1'b0}}} : '0;
  wire [SUM_BITS-1:0] whole = {1'b0, clamped} + addend;
  wire unused_fraction = &{1'b0, whole};  // the bits below the output's LSB

  wire overflow = |sum[OUT_BITS-1:`PHONGPIPE_OUTPUT_BITS];
  assign color = overflow ? '1 : sum[`PHONGPIPE_OUTPUT_BITS-1:0];

  always_ff @(posedge clk) begin
    if (enable[0]) begin
      lit <= $signed(diffuse) > $signed(level);
      diffuse_cut <= diffuse[DROPPED+:CUT_BITS];
      level_cut <= level[DROPPED+:CUT_BITS];
    end
    if (enable[1]) clamped <= lit ? diffuse_cut : level_cut;
    if (enable[2]) sum <= whole[SUM_BITS-1:SUM_FRACTION];
  end
endmodule
