// color_sum for every legal width of ROM words, with four fraction bits, on the same inputs. diffuse and level
// belong together.
module color_sum_words (
    input  logic        clk,
    input  logic [13:0] diffuse,
    input  logic [13:0] level,
    input  logic        open,
    input  logic [11:0] word,
    input  logic [11:0] increment,
    output logic        lit,
    output logic [89:0] sums,   // 10 bits each, the narrowest word in the low bits
    output logic [71:0] colors  // 8 bits each
);
  logic [8:0] lits;
  logic [13:0] s4_diffuse;
  always_ff @(posedge clk) s4_diffuse <= diffuse;
  for (genvar bits = 4; bits <= 12; bits++) begin : width
    color_sum #(
        .DIFFUSE_WIDTH(14),
        .WORD_BITS(bits)
    ) summation (
        .clk,
        .s4_diffuse,
        .s3_level(level),
        .s6_lit(lits[bits-4]),
        .s8_open(open),
        .s8_word(word[bits-1:0]),
        .s8_increment(increment[bits-1:0]),
        .s10_sum(sums[(bits-4)*10+:10]),
        .s10_color(colors[(bits-4)*8+:8])
    );
  end
  assign lit = &lits;
endmodule
