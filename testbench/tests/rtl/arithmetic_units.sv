// Each unit of hw/units/ in 8 and in 16 bits, and the one for 1/√x at its default format.
module arithmetic_units (
    input  logic        clk,
    input  logic [15:0] a,
    input  logic [15:0] b,
    output logic [ 7:0] sum_8,
    output logic [15:0] sum_16,
    output logic [15:0] product_8,
    output logic [31:0] product_16,
    output logic [ 7:0] quotient_8,
    output logic [15:0] quotient_16,

    input  logic        table_write,
    input  logic [ 8:0] table_address,
    input  logic [23:0] table_data,
    output logic [15:0] root
);
  unit_adder #(.WIDTH(8)) adder_8 (.clk, .a(a[7:0]), .b(b[7:0]), .sum(sum_8));
  unit_adder #(.WIDTH(16)) adder_16 (.clk, .a, .b, .sum(sum_16));
  unit_multiplier #(.A_BITS(8), .B_BITS(8)) multiplier_8 (.clk, .a(a[7:0]), .b(b[7:0]), .product(product_8));
  unit_multiplier #(.A_BITS(16), .B_BITS(16)) multiplier_16 (.clk, .a, .b, .product(product_16));
  unit_divider #(.WIDTH(8)) divider_8 (.clk, .dividend(a[7:0]), .divisor(b[7:0]), .quotient(quotient_8));
  unit_divider #(.WIDTH(16)) divider_16 (.clk, .dividend(a), .divisor(b), .quotient(quotient_16));
  unit_rsqrt rsqrt_16 (.clk, .x(a), .table_write, .table_address, .table_data, .root);
endmodule
