// One channel under depth cueing: min(255, cue + ((sum - cue) * factor + half) >> CUE_FACTOR_BITS).
//
// sum is in output LSB, rounded and not yet saturated; factor is the share of the pixel's own colour, 0
// to 2^CUE_FACTOR_BITS; cue is the colour it fades to. One colour a clock, latency 6: the difference; products
// with two bits of the factor each; three clocks of adding them up in pairs; the sum with cue, saturated.
`include "constants.svh"

module depth_cue #(
    parameter int SUM_BITS = 10
) (
    input  logic                                clk,
    input  logic [                SUM_BITS-1:0] s10_sum,
    input  logic [  `PHONGPIPE_OUTPUT_BITS-1:0] s10_cue,
    input  logic [`PHONGPIPE_CUE_FACTOR_BITS:0] s10_factor,
    output logic [  `PHONGPIPE_OUTPUT_BITS-1:0] s16_color
);
  localparam int FACTOR_BITS = `PHONGPIPE_CUE_FACTOR_BITS;
  localparam int OUTPUT_BITS = `PHONGPIPE_OUTPUT_BITS;
  localparam int PRODUCT_BITS = SUM_BITS + 1 + FACTOR_BITS;
  localparam int PAIRS = (FACTOR_BITS + 2) / 2;
  localparam int PART_BITS = SUM_BITS + 3;

  logic signed [SUM_BITS:0] s11_own;
  logic [2*PAIRS-1:0] s11_factor;
  // Side by side, the lowest first.
  logic [PAIRS*PART_BITS-1:0] s12_parts;
  logic [3*PRODUCT_BITS-1:0] s13_pairs;
  logic [2*PRODUCT_BITS-1:0] s14_sums;
  logic [PRODUCT_BITS-1:0] s15_product;
  logic [OUTPUT_BITS-1:0] s11_cue, s12_cue, s13_cue, s14_cue, s15_cue;
  wire [SUM_BITS:0] moved = s15_product[FACTOR_BITS+:SUM_BITS+1] + {{(SUM_BITS + 1 - OUTPUT_BITS) {1'b0}}, s15_cue};
  wire overflow = |moved[SUM_BITS:OUTPUT_BITS];  // between sum and cue, and so never negative
  wire unused = &{1'b0, s15_product[FACTOR_BITS-1:0]};

  wire signed [PART_BITS-1:0] one = PART_BITS'(s11_own);
  for (genvar i = 0; i < PAIRS; i++) begin : part
    always_ff @(posedge clk) begin
      s12_parts[i*PART_BITS+:PART_BITS] <= (s11_factor[2*i] ? one : '0) + (s11_factor[2*i+1] ? one <<< 1 : '0);
    end
  end
  for (genvar i = 0; i < 3; i++) begin : pair
    wire signed [PART_BITS-1:0] low = $signed(s12_parts[2*i*PART_BITS+:PART_BITS]);
    wire signed [PART_BITS-1:0] high = $signed(s12_parts[(2*i+1)*PART_BITS+:PART_BITS]);
    always_ff @(posedge clk) begin
      s13_pairs[i*PRODUCT_BITS+:PRODUCT_BITS] <=
          (PRODUCT_BITS'(low) <<< 4 * i) + (PRODUCT_BITS'(high) <<< 4 * i + 2);
    end
  end
  always_ff @(posedge clk) begin
    s11_own <= $signed({1'b0, s10_sum}) - $signed({{(SUM_BITS + 1 - OUTPUT_BITS) {1'b0}}, s10_cue});
    s11_factor <= (2*PAIRS)'(s10_factor);
    s14_sums <= {
      s13_pairs[2*PRODUCT_BITS+:PRODUCT_BITS] + PRODUCT_BITS'(1 << (FACTOR_BITS - 1)),
      s13_pairs[0+:PRODUCT_BITS] + s13_pairs[PRODUCT_BITS+:PRODUCT_BITS]
    };
    s15_product <= s14_sums[0+:PRODUCT_BITS] + s14_sums[PRODUCT_BITS+:PRODUCT_BITS];
    s16_color <= overflow ? '1 : moved[OUTPUT_BITS-1:0];
    {s11_cue, s12_cue, s13_cue, s14_cue, s15_cue} <= {s10_cue, s11_cue, s12_cue, s13_cue, s14_cue};
  end
endmodule
