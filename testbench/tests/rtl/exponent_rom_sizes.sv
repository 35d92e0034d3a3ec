// exponent_rom at every legal size, with one fraction bit, on the same inputs.
module exponent_rom_sizes (
    input  logic        clk,
    input  logic        address_enable,
    input  logic        read_enable,
    input  logic [15:0] v,
    output logic [95:0] words,  // 12 bits each, the smallest table in the low bits
    input  logic        write,
    input  logic [12:0] write_address,
    input  logic [11:0] write_word
);
  for (genvar bits = 6; bits <= 13; bits++) begin : size
    exponent_rom #(
        .VALUE_WIDTH(bits + 3),
        .ADDRESS_BITS(bits),
        .WORD_BITS(12)
    ) rom (
        .clk,
        .address_enable,
        .read_enable,
        .v(v[bits+2:0]),
        .word(words[(bits-6)*12+:12]),
        .write,
        .write_address(write_address[bits-1:0]),
        .write_word
    );
  end
endmodule
