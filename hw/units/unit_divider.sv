// quotient = dividend / divisor, rounded down; unsigned. All ones if the divisor is 0. One quotient a clock,
// WIDTH clocks from the operands: restoring division, a bit of the quotient in each clock, the highest first.
module unit_divider #(
    parameter int WIDTH = 16  // at least 2
) (
    input  logic             clk,
    input  logic [WIDTH-1:0] dividend,
    input  logic [WIDTH-1:0] divisor,
    output logic [WIDTH-1:0] quotient
);
  // Bits of the dividend that are still to come are above those of the quotient in `s_bits`.
  for (genvar k = 0; k < WIDTH; k++) begin : digit
    logic [WIDTH-1:0] s_divisor, s_remainder, s_bits;
    wire [WIDTH-1:0] digit_divisor, digit_remainder, digit_bits;
    if (k == 0) begin : first
      assign digit_divisor = divisor;
      assign digit_remainder = '0;
      assign digit_bits = dividend;
    end else begin : next
      assign digit_divisor = digit[k-1].s_divisor;
      assign digit_remainder = digit[k-1].s_remainder;
      assign digit_bits = digit[k-1].s_bits;
    end
    wire [WIDTH:0] shifted = {digit_remainder, digit_bits[WIDTH-1]};
    wire [WIDTH:0] difference = shifted - {1'b0, digit_divisor};
    wire fits = !difference[WIDTH] || shifted[WIDTH];
    always_ff @(posedge clk) begin
      s_divisor <= digit_divisor;
      s_remainder <= fits ? difference[WIDTH-1:0] : shifted[WIDTH-1:0];
      s_bits <= {digit_bits[WIDTH-2:0], fits};
    end
  end
  wire unused = &{1'b0, digit[WIDTH-1].s_divisor, digit[WIDTH-1].s_remainder};
  assign quotient = digit[WIDTH-1].s_bits;
endmodule
