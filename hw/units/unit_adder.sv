// sum = a + b, modulo 2^WIDTH. One sum a clock, 2 clocks from the operands: the low half, then the high half
// with its carry.
module unit_adder #(
    parameter int WIDTH = 16  // at least 2
) (
    input  logic             clk,
    input  logic [WIDTH-1:0] a,
    input  logic [WIDTH-1:0] b,
    output logic [WIDTH-1:0] sum
);
  localparam int LOW_BITS = WIDTH / 2;
  localparam int HIGH_BITS = WIDTH - LOW_BITS;

  logic [LOW_BITS:0] s1_low;
  logic [HIGH_BITS-1:0] s1_a, s1_b;
  // The carry is the low bit of both addends, so that one chain makes the sum.
  wire [HIGH_BITS:0] high = {s1_a, 1'b1} + {s1_b, s1_low[LOW_BITS]};
  wire unused = &{1'b0, high[0]};

  always_ff @(posedge clk) begin
    s1_low <= {1'b0, a[LOW_BITS-1:0]} + {1'b0, b[LOW_BITS-1:0]};
    s1_a <= a[WIDTH-1:LOW_BITS];
    s1_b <= b[WIDTH-1:LOW_BITS];
    sum <= {high[HIGH_BITS:1], s1_low[LOW_BITS-1:0]};
  end
endmodule
