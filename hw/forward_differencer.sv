// v(0) = start_v, v(i+1) = v(i) + d1(i); d1(0) = start_d1, d1(i+1) = d1(i) + d2. No rounding; sums wrap.
//
// Two accumulators in a row. The terms v, d1, d2, d2 … of a span go into the difference, which starts over at
// the first two of them, so that it is v(0), d1(0), d1(1) …; the differences go into v, which starts over at
// the first. So a span is loaded without a clock of its own. Each sum is made in two clocks: the low bits,
// then the upper HIGH_BITS with the carry of the low ones.
//
// The inputs are taken in every clock, and count where first[0] is high in the next. Stages of a pixel, by
// the number in a register's name: 1 its term; 2 the low bits of its difference; 3 the upper ones, and the
// low bits of v; 4 v.
`include "constants.svh"

module forward_differencer #(
    parameter int WIDTH = 26
) (
    input  logic             clk,
    input  logic             stepping,  // low: every v of the span is start_v
    input  logic [WIDTH-1:0] start_v,
    input  logic [WIDTH-1:0] start_d1,
    input  logic [WIDTH-1:0] start_d2,
    input  logic [      3:0] valid,     // a pixel is in stage 0, 1, 2, 3
    input  logic [      3:0] first,     // and is the first of its span
    input  logic [      2:1] restart,   // or the second, in stage 1, 2
    output logic [WIDTH-1:0] s4_v
);
  localparam int LOW_BITS = WIDTH > `PHONGPIPE_HIGH_BITS ? WIDTH - `PHONGPIPE_HIGH_BITS : 1;
  localparam int HIGH_BITS = WIDTH - LOW_BITS;

  logic [WIDTH-1:0] s0_start_v, s0_start_d1, s1_term, s1_next_term, s1_last_term;
  logic s0_stepping;
  logic [LOW_BITS-1:0] s2_difference_low, s3_v_low;
  logic [HIGH_BITS-1:0] s2_term_high, s3_difference_high;
  logic s2_carry, s3_carry;

  // A carry is the low bit of both addends, so that one chain makes the sum.
  wire [LOW_BITS:0] difference_low = {1'b0, s2_difference_low} + {1'b0, s1_term[LOW_BITS-1:0]};
  wire [HIGH_BITS:0] difference_high = {s3_difference_high, 1'b1} + {s2_term_high, s2_carry};
  wire [LOW_BITS:0] v_low = {1'b0, s3_v_low} + {1'b0, s2_difference_low};
  wire [HIGH_BITS:0] v_high = {s4_v[WIDTH-1:LOW_BITS], 1'b1} + {s3_difference_high, s3_carry};
  wire unused = &{1'b0, difference_high[0], v_high[0], first[1]};

  span_register #(
      .WIDTH(WIDTH)
  ) last_term (
      .clk,
      .load(first[0]),
      .start(start_d2 & {WIDTH{stepping}}),
      .value(s1_last_term)
  );
  always_ff @(posedge clk) begin
    s0_start_v <= start_v;
    s0_start_d1 <= start_d1;
    s0_stepping <= stepping;
    if (valid[0]) begin
      s1_term <= first[0] ? s0_start_v : s1_next_term;
      s1_next_term <= first[0] ? s0_start_d1 & {WIDTH{s0_stepping}} : s1_last_term;
    end
    if (valid[1]) begin
      s2_difference_low <= restart[1] ? s1_term[LOW_BITS-1:0] : difference_low[LOW_BITS-1:0];
      s2_carry <= difference_low[LOW_BITS] & ~restart[1];
    end
    s2_term_high <= s1_term[WIDTH-1:LOW_BITS];
    if (valid[2]) begin
      s3_difference_high <= restart[2] ? s2_term_high : difference_high[HIGH_BITS:1];
      s3_v_low <= first[2] ? s2_difference_low : v_low[LOW_BITS-1:0];
      s3_carry <= v_low[LOW_BITS] & ~first[2];
    end
    if (valid[3]) s4_v[WIDTH-1:LOW_BITS] <= first[3] ? s3_difference_high : v_high[HIGH_BITS:1];
    s4_v[LOW_BITS-1:0] <= s3_v_low;
  end
endmodule
