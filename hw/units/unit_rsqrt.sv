// root ≈ 1/√x for x from 1 to below 4, by a table and linear interpolation, at most 1.7 LSB off. x is
// 2.(WIDTH - 2), root 0.WIDTH, both unsigned. One root a clock, DELTA_BITS + 4 clocks from the operand.
//
// The table has a word for each value of the upper TABLE_BITS bits of x: the root at the middle of that interval,
// 0.WIDTH, and what it falls by over the interval, SLOPE_BITS bits of the same weight. It is loaded through table_*,
// a word a clock, while no operand is in flight; its words are those of rsqrt_table() in model/fixed/units.h.
module unit_rsqrt #(
    parameter  int WIDTH      = 16,
    parameter  int TABLE_BITS = 9,
    parameter  int SLOPE_BITS = 8,
    localparam int DELTA_BITS = WIDTH - TABLE_BITS
) (
    input  logic                        clk,
    input  logic [           WIDTH-1:0] x,
    input  logic                        table_write,
    input  logic [      TABLE_BITS-1:0] table_address,
    input  logic [WIDTH+SLOPE_BITS-1:0] table_data,
    output logic [           WIDTH-1:0] root
);
  logic [WIDTH+SLOPE_BITS-1:0] words[2**TABLE_BITS];
  logic [TABLE_BITS-1:0] s1_address;
  logic [DELTA_BITS-1:0] s1_delta, s2_delta, s3_delta;
  logic [WIDTH+SLOPE_BITS-1:0] s2_word, s3_word;
  always_ff @(posedge clk) begin
    if (table_write) words[table_address] <= table_data;
    s1_address <= x[WIDTH-1:DELTA_BITS];
    // From the middle of the interval, in two's complement.
    s1_delta <= {~x[DELTA_BITS-1], x[DELTA_BITS-2:0]};
    s2_word <= words[s1_address];
    s2_delta <= s1_delta;
    s3_word <= s2_word;
    s3_delta <= s2_delta;
  end

  wire [SLOPE_BITS+DELTA_BITS:0] fall;
  unit_multiplier #(
      .A_BITS(SLOPE_BITS + 1),
      .B_BITS(DELTA_BITS)
  ) multiplier (
      .clk,
      .a({1'b0, s3_word[SLOPE_BITS-1:0]}),
      .b(s3_delta),
      .product(fall)
  );
  // The root at the middle waits for the product.
  logic [DELTA_BITS*WIDTH-1:0] s_middle;
  wire [SLOPE_BITS:0] whole = fall[SLOPE_BITS+DELTA_BITS:DELTA_BITS];
  wire unused = &{1'b0, fall[DELTA_BITS-1:0]};
  always_ff @(posedge clk) begin
    s_middle <= {s_middle[(DELTA_BITS-1)*WIDTH-1:0], s3_word[WIDTH+SLOPE_BITS-1:SLOPE_BITS]};
    root <= s_middle[(DELTA_BITS-1)*WIDTH+:WIDTH] - {{(WIDTH - SLOPE_BITS - 1) {whole[SLOPE_BITS]}}, whole};
  end
endmodule
