// forward_differencer at the narrowest, a usual and the widest width, on the same inputs, with the control that
// it has in pixel_datapath.
module forward_differencer_widths (
    input  logic        clk,
    input  logic        enter,  // a pixel
    input  logic        load,   // which is the first of a span
    input  logic        stepping,
    input  logic [63:0] start_v,
    input  logic [63:0] start_d1,
    input  logic [63:0] start_d2,
    output logic [ 8:0] v9,
    output logic [25:0] v26,
    output logic [39:0] v40
);
  logic [3:0] valid, first;
  logic [2:1] restart;
  logic after_first;
  always_ff @(posedge clk) begin
    valid <= {valid[2:0], enter};
    first <= {first[2:0], load};
    restart <= {restart[1], first[0] || after_first};
    if (valid[0]) after_first <= first[0];
  end
  forward_differencer #(.WIDTH(9)) width9 (
      .clk, .stepping, .start_v(start_v[8:0]), .start_d1(start_d1[8:0]), .start_d2(start_d2[8:0]),
      .valid, .first, .restart, .s4_v(v9));
  forward_differencer #(.WIDTH(26)) width26 (
      .clk, .stepping, .start_v(start_v[25:0]), .start_d1(start_d1[25:0]), .start_d2(start_d2[25:0]),
      .valid, .first, .restart, .s4_v(v26));
  forward_differencer #(.WIDTH(40)) width40 (
      .clk, .stepping, .start_v(start_v[39:0]), .start_d1(start_d1[39:0]), .start_d2(start_d2[39:0]),
      .valid, .first, .restart, .s4_v(v40));
  wire unused = &{1'b0, start_v, start_d1, start_d2};
endmodule
