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
// One word a clock, 4 clocks after v: the address; the place of the word, or, in the plain layout, the word
// of each bank of block RAM; the word; a register behind it, for a memory's output is slow, or the bank. The
// power is word + increment, modulo 2^(bits of a channel's word); the increment is 0 but for bipartite.
// The table is written through its own port, one word a clock, while no pixel is in flight: bases, then
// increments. A word is in the table 2 clocks after it was on the port.
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
    input  logic [ VALUE_WIDTH-1:0] s4_v,
    output logic [   WORD_BITS-1:0] s8_word,
    output logic [   WORD_BITS-1:0] s8_increment,
    input  logic                    write,
    input  logic [ADDRESS_BITS-1:0] write_address,
    input  logic [   WORD_BITS-1:0] write_word
);
  localparam int FRACTION_BITS = VALUE_WIDTH - 1 - GUARD_BITS - ADDRESS_BITS;

  wire negative = s4_v[VALUE_WIDTH-1];
  wire above = |s4_v[VALUE_WIDTH-2-:GUARD_BITS];
  wire [ADDRESS_BITS-1:0] integer_part = s4_v[FRACTION_BITS+:ADDRESS_BITS];
  wire unused_fraction = &{1'b0, s4_v[FRACTION_BITS-1:0]};

  logic [ADDRESS_BITS-1:0] s5_address;
  logic [WORD_BITS-1:0] new_word;  // of the write port, a clock later
  always_ff @(posedge clk) begin
    s5_address <= negative ? '0 : above ? '1 : integer_part;
    new_word <= write_word;
  end

  // No table is written while pixels are in flight, so that what a place gives in the clock in which it is
  // written does not matter.
  if (LAYOUT == `PHONGPIPE_LAYOUT_PLAIN) begin : plain
    // 2 bits of so many words fill a block RAM of 4096 bits.
    localparam int BANK_BITS = ADDRESS_BITS > 11 ? 11 : ADDRESS_BITS;  // of an address, in its bank
    localparam int BANKS = 1 << (ADDRESS_BITS - BANK_BITS);
    localparam int SELECT_BITS = BANKS == 1 ? 1 : ADDRESS_BITS - BANK_BITS;
    logic [BANKS*WORD_BITS-1:0] s7_words;
    logic [SELECT_BITS-1:0] s6_bank, s7_bank;
    logic [BANK_BITS-1:0] new_place;
    for (genvar b = 0; b < BANKS; b++) begin : bank
      (* no_rw_check *) logic [WORD_BITS-1:0] table_words[1 << BANK_BITS];
      logic write_bank;
      logic [WORD_BITS-1:0] s6_word;
      always_ff @(posedge clk) begin
        s6_word <= table_words[s5_address[BANK_BITS-1:0]];
        s7_words[b*WORD_BITS+:WORD_BITS] <= s6_word;
        write_bank <= write && write_address >> BANK_BITS == ADDRESS_BITS'(b);
        if (write_bank) table_words[new_place] <= new_word;
      end
    end
    always_ff @(posedge clk) begin
      new_place <= write_address[BANK_BITS-1:0];
      s6_bank <= SELECT_BITS'(s5_address >> BANK_BITS);
      s7_bank <= s6_bank;
      s8_word <= s7_words[s7_bank*WORD_BITS+:WORD_BITS];
    end
    assign s8_increment = '0;
  end else begin : octave
    localparam int BLOCK_BITS = ADDRESS_BITS - OCTAVES;
    localparam int BLOCKS = OCTAVES + 1;
    localparam int LOW_BITS = LAYOUT == `PHONGPIPE_LAYOUT_BIPARTITE ? (BLOCK_BITS + 2) / 3 : 0;
    localparam int ENTRY_BITS = BLOCK_BITS - LOW_BITS;  // of a word in its block
    localparam int BASES = BLOCKS << ENTRY_BITS;
    localparam int PLACE_BITS = $clog2(BASES);

    // The block, and the bits of c below the leading one.
    wire [ADDRESS_BITS-1:0] c = ~s5_address;
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

    (* no_rw_check *) logic [WORD_BITS-1:0] table_words[BASES];
    logic [PLACE_BITS-1:0] s6_place, new_place;
    logic [WORD_BITS-1:0] s7_word;
    logic write_base;
    wire of_increments = LAYOUT == `PHONGPIPE_LAYOUT_BIPARTITE
                       && write_address[ADDRESS_BITS-1:ENTRY_BITS] >= (ADDRESS_BITS - ENTRY_BITS)'(BLOCKS);
    always_ff @(posedge clk) begin
      s6_place <= (block << ENTRY_BITS) | PLACE_BITS'(below[BLOCK_BITS-1:LOW_BITS]);
      s7_word <= table_words[s6_place];
      s8_word <= s7_word;
      write_base <= write && !of_increments;
      new_place <= PLACE_BITS'(write_address);
      if (write_base) table_words[new_place] <= new_word;
    end

    if (LAYOUT == `PHONGPIPE_LAYOUT_BIPARTITE) begin : second_table
      (* no_rw_check *) logic [WORD_BITS-1:0] table_increments[BASES];
      logic [PLACE_BITS-1:0] s6_increment_place, new_increment_place;
      logic [WORD_BITS-1:0] s7_increment;
      logic write_increment;
      always_ff @(posedge clk) begin
        s6_increment_place <= PLACE_BITS'(
            (32'(block) << ENTRY_BITS) | ((32'(below) >> 2 * LOW_BITS) << LOW_BITS)
            | (32'(below) & ((1 << LOW_BITS) - 1)));
        s7_increment <= table_increments[s6_increment_place];
        s8_increment <= s7_increment;
        write_increment <= write && of_increments;
        new_increment_place <= {
          write_address[PLACE_BITS-1:ENTRY_BITS] - (PLACE_BITS - ENTRY_BITS)'(BLOCKS), write_address[ENTRY_BITS-1:0]
        };
        if (write_increment) table_increments[new_increment_place] <= new_word;
      end
    end else begin : one_table
      assign s8_increment = '0;
    end
  end
endmodule
