// color_sum for every legal width of ROM words, with four fraction bits, on the same inputs.
module color_sum_words (
    input  logic        clk,
    input  logic [ 2:0] enable,
    input  logic [13:0] diffuse,
    input  logic [13:0] level,
    input  logic        highlight_open,
    input  logic [11:0] word,
    output logic        lit,
    output logic [89:0] sums,   // 10 bits each, the narrowest word in the low bits
    output logic [71:0] colors  // 8 bits each
);
  logic [8:0] lits;
  for (genvar bits = 4; bits <= 12; bits++) begin : width
    color_sum #(
        .DIFFUSE_WIDTH(14),
        .WORD_BITS(bits)
    ) summation (
        .clk,
        .enable,
        .diffuse,
        .level,
        .lit(lits[bits-4]),
        .highlight_open,
        .word(word[bits-1:0]),
        .sum(sums[(bits-4)*10+:10]),
        .color(colors[(bits-4)*8+:8])
    );
  end
  assign lit = &lits;
endmodule
