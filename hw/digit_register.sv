// A word from its digits, the lowest first. It is whole in the clock after its last digit was at s1_digit, until
// the next digit is taken: stage 3. A clock later it is in stage 4.
`include "constants.svh"

module digit_register #(
    parameter int WIDTH  = 26,
    parameter int DIGITS = 4    // of DIGIT_BITS bits; what is above WIDTH does not count
) (
    input  logic                             clk,
    input  logic                             take,
    input  logic [`PHONGPIPE_DIGIT_BITS-1:0] s1_digit,
    output logic [                WIDTH-1:0] s3_v,
    output logic [                WIDTH-1:0] s4_v
);
  logic [DIGITS*`PHONGPIPE_DIGIT_BITS-1:0] digits;
  assign s3_v = digits[WIDTH-1:0];
  wire unused = &{1'b0, digits};  // bits above WIDTH

  always_ff @(posedge clk) begin
    if (take) digits <= {s1_digit, digits[DIGITS*`PHONGPIPE_DIGIT_BITS-1:`PHONGPIPE_DIGIT_BITS]};
    s4_v <= s3_v;
  end
endmodule
