// Where each of LANES datapaths starts that take turns along a span, and by how much it steps, from the start of
// the whole span: lane k has the pixels k, k + LANES, k + 2 LANES …
//
//   v_k = v + k d1 + k (k-1)/2 d2       d1_k = LANES d1 + (LANES (LANES-1)/2 + LANES k) d2       d2_k = LANES² d2
//
// No rounding; sums wrap. Stage 1 takes the inputs. Stages 2 and 3 make a sum of two each, and with 4 lanes a
// third one follows without a register.
module series_lanes #(
    parameter int WIDTH = 26,
    parameter int LANES = 2    // 2 or 4
) (
    input  logic                   clk,
    input  logic                   advance,   // every stage takes what is before it
    input  logic                   stepping,  // low: d1 and d2 are taken as 0
    input  logic [      WIDTH-1:0] v,
    input  logic [      WIDTH-1:0] d1,
    input  logic [      WIDTH-1:0] d2,
    output logic [LANES*WIDTH-1:0] lane_v,    // lane 0 in the low bits
    output logic [LANES*WIDTH-1:0] lane_d1,
    output logic [      WIDTH-1:0] lane_d2
);
  // The number after the l is the stage. lane_1 and lane_2 are v_1 and v_2; both is d1 + d2; two and two_1 are
  // d1_0 and d1_1 of two lanes; thrice is 3 d2; half_1 to half_3 are half of d1_1 to d1_3 of four lanes.
  logic [WIDTH-1:0] l1_v, l1_d1, l1_d2;
  logic [WIDTH-1:0] l2_v, l2_lane_1, l2_d2, l2_two;
  logic [WIDTH-1:0] l3_v, l3_lane_1, l3_d2, l3_two_1;

  always_ff @(posedge clk) begin
    if (advance) begin
      l1_v <= v;
      l1_d1 <= d1 & {WIDTH{stepping}};
      l1_d2 <= d2 & {WIDTH{stepping}};
      l2_v <= l1_v;
      l2_d2 <= l1_d2;
      l2_lane_1 <= l1_v + l1_d1;
      l2_two <= (l1_d1 << 1) + l1_d2;
      l3_v <= l2_v;
      l3_d2 <= l2_d2;
      l3_lane_1 <= l2_lane_1;
      l3_two_1 <= l2_two + (l2_d2 << 1);
    end
  end

  if (LANES == 2) begin : lanes_2
    logic [WIDTH-1:0] l3_two;
    always_ff @(posedge clk) if (advance) l3_two <= l2_two;
    assign lane_v  = {l3_lane_1, l3_v};
    assign lane_d1 = {l3_two_1, l3_two};
    assign lane_d2 = l3_d2 << 2;
  end else begin : lanes_4
    logic [WIDTH-1:0] l2_both, l2_thrice, l3_lane_2, l3_both_and_d2, l3_thrice;
    always_ff @(posedge clk) begin
      if (advance) begin
        l2_both <= l1_d1 + l1_d2;
        l2_thrice <= l1_d2 + (l1_d2 << 1);
        l3_lane_2 <= l2_lane_1 + l2_both;
        l3_both_and_d2 <= l2_both + l2_d2;
        l3_thrice <= l2_thrice;
      end
    end
    wire [WIDTH-1:0] half_1 = l3_two_1 + (l3_d2 << 1);
    wire [WIDTH-1:0] half_2 = l3_two_1 + (l3_d2 << 2);
    wire [WIDTH-1:0] half_3 = l3_two_1 + (l3_thrice << 1);
    assign lane_v  = {l3_lane_2 + l3_both_and_d2, l3_lane_2, l3_lane_1, l3_v};
    assign lane_d1 = {half_3 << 1, half_2 << 1, half_1 << 1, l3_two_1 << 1};
    assign lane_d2 = l3_d2 << 4;
  end
endmodule
