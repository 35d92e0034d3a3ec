// word = table[saturate(integer part of v)]: the power of Phong's highlight, one word a channel.
//
// v is s(1 + GUARD_BITS + ADDRESS_BITS).(fraction). Below 0 the address is 0; at or above full scale
// it is the last. Latency 2: the address is registered under `address_enable`, the word is read under
// `read_enable`. The table is written through its own port, one word a clock, while no pixel is in
// flight.
`include "constants.svh"

module exponent_rom #(
    parameter int VALUE_WIDTH  = 24,
    parameter int ADDRESS_BITS = 10,
    parameter int WORD_BITS    = 8
) (
    input  logic                    clk,
    input  logic                    address_enable,
    input  logic                    read_enable,
    input  logic [ VALUE_WIDTH-1:0] v,
    output logic [   WORD_BITS-1:0] word,
    input  logic                    write,
    input  logic [ADDRESS_BITS-1:0] write_address,
    input  logic [   WORD_BITS-1:0] write_word
);
  localparam int FRACTION_BITS = VALUE_WIDTH - 1 - `PHONGPIPE_GUARD_BITS - ADDRESS_BITS;

  logic [WORD_BITS-1:0] table_words[1 << ADDRESS_BITS];
  logic [ADDRESS_BITS-1:0] address;

  wire negative = v[VALUE_WIDTH-1];
  wire above = |v[VALUE_WIDTH-2-:`PHONGPIPE_GUARD_BITS];
  wire [ADDRESS_BITS-1:0] integer_part = v[FRACTION_BITS+:ADDRESS_BITS];
  wire unused_fraction = &{1'b0, v[FRACTION_BITS-1:0]};

  always_ff @(posedge clk) begin
    if (address_enable) begin
      address <= negative ? '0 : above ? '1 : integer_part;
    end
    if (read_enable) word <= table_words[address];
    if (write) table_words[write_address] <= write_word;
  end
endmodule
