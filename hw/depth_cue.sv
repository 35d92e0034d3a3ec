// One channel under depth cueing: min(255, cue + ((sum - cue) * factor + half) >> CUE_FACTOR_BITS).
//
// sum is in output LSB, rounded and not yet saturated; factor is the share of the pixel's own colour, 0
// to 2^CUE_FACTOR_BITS; cue is the colour it fades to. Latency 1, one multiplier.
`include "constants.svh"

module depth_cue #(
    parameter int SUM_BITS = 10
) (
    input  logic                                 clk,
    input  logic                                 enable,
    input  logic [                 SUM_BITS-1:0] sum,
    input  logic [   `PHONGPIPE_OUTPUT_BITS-1:0] cue,
    input  logic [`PHONGPIPE_CUE_FACTOR_BITS:0] factor,
    output logic [   `PHONGPIPE_OUTPUT_BITS-1:0] color
);
  localparam int FACTOR_BITS = `PHONGPIPE_CUE_FACTOR_BITS;
  localparam int OUTPUT_BITS = `PHONGPIPE_OUTPUT_BITS;
  localparam int PRODUCT_BITS = SUM_BITS + 1 + FACTOR_BITS + 2;  // both factors with a sign

  wire signed [SUM_BITS:0] own = $signed({1'b0, sum}) - $signed({{(SUM_BITS + 1 - OUTPUT_BITS) {1'b0}}, cue});
  wire signed [FACTOR_BITS+1:0] share = $signed({1'b0, factor});
  wire signed [PRODUCT_BITS-1:0] product = own * share;
  wire signed [PRODUCT_BITS-1:0] rounded = product + (1 <<< (FACTOR_BITS - 1));
  wire [SUM_BITS:0] moved = rounded[FACTOR_BITS+:SUM_BITS+1]
                          + {{(SUM_BITS + 1 - OUTPUT_BITS) {1'b0}}, cue};
  wire overflow = |moved[SUM_BITS:OUTPUT_BITS];  // between sum and cue, and so never negative
  wire unused = &{1'b0, rounded[PRODUCT_BITS-1:FACTOR_BITS+SUM_BITS+1], rounded[FACTOR_BITS-1:0]};

  always_ff @(posedge clk) if (enable) color <= overflow ? '1 : moved[OUTPUT_BITS-1:0];
endmodule
