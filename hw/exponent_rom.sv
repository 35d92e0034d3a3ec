// word = table[address of v]: the power of Phong's highlight, one word a channel.
//
// v is s(1 + GUARD_BITS + ADDRESS_BITS).(fraction). The address is its integer part: 0 if v is below 0,
// the last one if v is at or above full scale. LAYOUT says where the word of an address is:
//
//   plain      at the address.
//   octave     c = ~address is 0 where the highlight is brightest. Each of the OCTAVES of c, which its
//              leading one tells, has 2^BLOCK_BITS words; so has what lies below the lowest. They are
//              blocks of the table, brightest first.
//   bipartite  as octave, but the bits of c below the leading one are high, middle and low. The words at
//              block, high and middle are the base, those at block, high and low the increment.
//
// Latency 2: the address is registered under `address_enable`, the words are read under `read_enable`.
// The power is word + increment, modulo 2^(bits of a channel's word); the increment is 0 but for bipartite.
// The table is written through its own port, one word a clock, while no pixel is in flight: bases, then
// increments.
`include "constants.svh"

module exponent_rom #(
    parameter int VALUE_WIDTH  = 24,
    parameter int GUARD_BITS   = `PHONGPIPE_GUARD_BITS,
    parameter int ADDRESS_BITS = 10,
    parameter int WORD_BITS    = 8,
    parameter int LAYOUT       = `PHONGPIPE_LAYOUT_PLAIN,
    parameter int OCTAVES      = 4
) (
    input  logic                    clk,
    input  logic                    address_enable,
    input  logic                    read_enable,
    input  logic [ VALUE_WIDTH-1:0] v,
    output logic [   WORD_BITS-1:0] word,
    output logic [   WORD_BITS-1:0] increment,
    input  logic                    write,
    input  logic [ADDRESS_BITS-1:0] write_address,
    input  logic [   WORD_BITS-1:0] write_word
);
  localparam int FRACTION_BITS = VALUE_WIDTH - 1 - GUARD_BITS - ADDRESS_BITS;
  localparam int BLOCK_BITS = ADDRESS_BITS - OCTAVES;  // of the octave layouts
  localparam int BLOCKS = OCTAVES + 1;
  localparam int LOW_BITS = LAYOUT == `PHONGPIPE_LAYOUT_BIPARTITE ? (BLOCK_BITS + 2) / 3 : 0;
  localparam int ENTRY_BITS = BLOCK_BITS - LOW_BITS;  // of a word in its block
  localparam int BASES = LAYOUT == `PHONGPIPE_LAYOUT_PLAIN ? 1 << ADDRESS_BITS : BLOCKS << ENTRY_BITS;

  localparam int PLACE_BITS = BASES == 1 ? 1 : $clog2(BASES);

  logic [WORD_BITS-1:0] table_words[BASES];
  logic [ADDRESS_BITS-1:0] address;
  wire [PLACE_BITS-1:0] place;  // of the word

  wire negative = v[VALUE_WIDTH-1];
  wire above = |v[VALUE_WIDTH-2-:GUARD_BITS];
  wire [ADDRESS_BITS-1:0] integer_part = v[FRACTION_BITS+:ADDRESS_BITS];
  wire unused_fraction = &{1'b0, v[FRACTION_BITS-1:0]};
  wire write_increment = LAYOUT == `PHONGPIPE_LAYOUT_BIPARTITE && write_address >= ADDRESS_BITS'(BASES);

  always_ff @(posedge clk) begin
    if (address_enable) begin
      address <= negative ? '0 : above ? '1 : integer_part;
    end
    if (read_enable) word <= table_words[place];
    if (write && !write_increment) table_words[PLACE_BITS'(write_address)] <= write_word;
  end

  if (LAYOUT == `PHONGPIPE_LAYOUT_PLAIN) begin : plain
    assign place = address;
    assign increment = '0;
  end else begin : octave
    // The block, and the bits of c below the leading one.
    wire [ADDRESS_BITS-1:0] c = ~address;
    logic [PLACE_BITS-1:0] block;
    logic [BLOCK_BITS-1:0] below;
    always_comb begin
      block = '0;
      below = c[BLOCK_BITS-1:0];
      for (int b = 1; b < BLOCKS; b++) begin
        if (c[BLOCK_BITS+b-1]) begin
          block = PLACE_BITS'(b);
          below = c[b-1+:BLOCK_BITS];
        end
      end
    end
    assign place = (block << ENTRY_BITS) | PLACE_BITS'(below[BLOCK_BITS-1:LOW_BITS]);

    if (LAYOUT == `PHONGPIPE_LAYOUT_BIPARTITE) begin : second_table
      logic [WORD_BITS-1:0] table_increments[BASES];
      wire [PLACE_BITS-1:0] increment_place = PLACE_BITS'(
          (32'(block) << ENTRY_BITS) | ((32'(below) >> 2 * LOW_BITS) << LOW_BITS)
          | (32'(below) & ((1 << LOW_BITS) - 1)));
      wire [PLACE_BITS-1:0] write_place = PLACE_BITS'(write_address - ADDRESS_BITS'(BASES));
      always_ff @(posedge clk) begin
        if (read_enable) increment <= table_increments[increment_place];
        if (write && write_increment) table_increments[write_place] <= write_word;
      end
    end else begin : one_table
      assign increment = '0;
    end
  end
endmodule
