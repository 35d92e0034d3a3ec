// forward_differencer at the narrowest, a usual and the widest width, on the same inputs.
module forward_differencer_widths (
    input  logic        clk,
    input  logic        load,
    input  logic        step,
    input  logic [63:0] start_v,
    input  logic [63:0] start_d1,
    input  logic [63:0] start_d2,
    output logic [ 8:0] v9,
    output logic [25:0] v26,
    output logic [39:0] v40
);
  forward_differencer #(.WIDTH(9)) width9 (
      .clk, .load, .step, .start_v(start_v[8:0]), .start_d1(start_d1[8:0]),
      .start_d2(start_d2[8:0]), .v(v9));
  forward_differencer #(.WIDTH(26)) width26 (
      .clk, .load, .step, .start_v(start_v[25:0]), .start_d1(start_d1[25:0]),
      .start_d2(start_d2[25:0]), .v(v26));
  forward_differencer #(.WIDTH(40)) width40 (
      .clk, .load, .step, .start_v(start_v[39:0]), .start_d1(start_d1[39:0]),
      .start_d2(start_d2[39:0]), .v(v40));
  wire unused = &{1'b0, start_v, start_d1, start_d2};
endmodule
