// exponent_rom at every legal size in every layout, with one fraction bit, on the same inputs. The octave
// layouts have 1 to 4 octaves, in turn.
`include "constants.svh"

module exponent_rom_sizes (
    input  logic         clk,
    input  logic [ 15:0] v,
    output logic [287:0] words,  // 12 bits each, increments added: by layout, the smallest table first
    input  logic         write,
    input  logic [ 12:0] write_address,
    input  logic [ 11:0] write_word
);
  for (genvar layout = 0; layout <= `PHONGPIPE_LAYOUT_BIPARTITE; layout++) begin : in_layout
    for (genvar bits = 6; bits <= 13; bits++) begin : size
      localparam int OCTAVES = 1 + bits % 4;
      localparam int BLOCK = bits - OCTAVES;
      localparam int LOW = (BLOCK + 2) / 3;
      localparam int WORDS = layout == `PHONGPIPE_LAYOUT_OCTAVE ? (OCTAVES + 1) << BLOCK
                                                                : 2 * (OCTAVES + 1) << (BLOCK - LOW);
      logic [11:0] word, increment;
      exponent_rom #(
          .VALUE_WIDTH(bits + 3),
          .ADDRESS_BITS(bits),
          .WORD_BITS(12),
          .LAYOUT(layout),
          .OCTAVES(OCTAVES)
      ) rom (
          .clk,
          .s4_v(v[bits+2:0]),
          .s8_word(word),
          .s8_increment(increment),
          .write(write && (layout == `PHONGPIPE_LAYOUT_PLAIN || 32'(write_address) < WORDS)),
          .write_address(write_address[bits-1:0]),
          .write_word
      );
      assign words[(8*layout+bits-6)*12+:12] = word + increment;
    end
  end
endmodule
