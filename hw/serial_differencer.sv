// All series of a pixel, a digit of DIGIT_BITS bits of one series a clock: v(i+1) = v(i) + d1(i),
// d1(i+1) = d1(i) + d2. Sums wrap at the top of the last digit, of which only the bits of the register count.
//
// v and d1 are in block RAM, a digit of both in one word; of a span's first pixel they are at the port instead,
// and so is d2 of each. A pixel takes SERIES × DIGITS clocks, in which the digits of a series come lowest first.
// Stages, by the number in a register's name: 0 the place of a digit; 1 its bits; 2 those of the next pixel,
// which are written.
//
// A pixel may start in every clock in which `idle` is high. DIGITS is at least 3: so long must a place rest
// between two reads.
`include "constants.svh"

module serial_differencer #(
    parameter int SERIES = 2,
    parameter int DIGITS = 4,
    localparam int DIGIT_BITS = `PHONGPIPE_DIGIT_BITS,
    localparam int SERIES_BITS = `PHONGPIPE_SERIES_BITS,
    localparam int PLACE_BITS = `PHONGPIPE_DIGIT_PLACE_BITS
) (
    input  logic                   clk,
    input  logic                   reset,
    output logic                   idle,
    input  logic                   start,      // with idle: a pixel, from this clock on
    input  logic                   first,      // it is the first of its span
    input  logic [     SERIES-1:0] s1_stepping,  // of a span: else a series stays as it starts
    output logic [SERIES_BITS-1:0] series,     // the place of a digit, in this clock
    output logic [ PLACE_BITS-1:0] digit,
    input  logic [ DIGIT_BITS-1:0] s1_start_v,  // of that place, a clock later
    input  logic [ DIGIT_BITS-1:0] s1_start_d1,
    input  logic [ DIGIT_BITS-1:0] s1_start_d2,
    output logic [     SERIES-1:0] s1_of_series,  // a digit of v is here, of that series
    output logic [ DIGIT_BITS-1:0] s1_v,
    output logic                   s1_last      // and it is the last one of a pixel
);
  localparam int LAST_DIGIT = DIGITS - 1;
  localparam int LAST_SERIES = SERIES - 1;

  wire step = start || !idle;
  wire last_digit = digit == PLACE_BITS'(LAST_DIGIT);
  wire last = last_digit && series == SERIES_BITS'(LAST_SERIES);

  (* no_rw_check *) logic [2*DIGIT_BITS-1:0] places[1 << (SERIES_BITS + PLACE_BITS)];
  logic [2*DIGIT_BITS-1:0] s1_word, s2_word;
  logic [SERIES_BITS+PLACE_BITS-1:0] s1_place, s2_place;
  logic s1_first, s1_step, s1_carries, s2_step, v_carry, d1_carry;

  wire stepping = |(s1_of_series & s1_stepping);
  assign s1_v = s1_first ? s1_start_v : s1_word[DIGIT_BITS-1:0];
  wire [DIGIT_BITS-1:0] s1_d1 = (s1_first ? s1_start_d1 : s1_word[DIGIT_BITS+:DIGIT_BITS]) & {DIGIT_BITS{stepping}};
  // A carry is the low bit of both addends, so that one chain makes the sum.
  wire [DIGIT_BITS+1:0] next_v = {1'b0, s1_v, 1'b1} + {1'b0, s1_d1, v_carry};
  wire [DIGIT_BITS+1:0] next_d1 = {1'b0, s1_d1, 1'b1} + {1'b0, s1_start_d2, d1_carry};
  wire unused = &{1'b0, next_v[0], next_d1[0]};

  for (genvar s = 0; s < SERIES; s++) begin : of_series
    assign s1_of_series[s] = s1_step && s1_place[PLACE_BITS+:SERIES_BITS] == SERIES_BITS'(s);
  end

  always_ff @(posedge clk) begin
    if (idle) s1_first <= first;
    s1_place <= {series, digit};
    s1_word <= places[{series, digit}];
    v_carry <= next_v[DIGIT_BITS+1] && s1_carries;
    d1_carry <= next_d1[DIGIT_BITS+1] && s1_carries;
    s2_place <= s1_place;
    s2_word <= {next_d1[DIGIT_BITS:1], next_v[DIGIT_BITS:1]};
    if (s2_step) places[s2_place] <= s2_word;
    if (reset) begin
      idle <= 1'b1;
      {series, digit, s1_step, s1_carries, s1_last, s2_step} <= '0;
    end else begin
      s1_step <= step;
      s1_carries <= step && !last_digit;
      s1_last <= step && last;
      s2_step <= s1_step;
      if (step) begin
        idle <= last;
        digit <= last_digit ? '0 : digit + 1'b1;
        if (last_digit) series <= last ? '0 : series + 1'b1;
      end
    end
  end
endmodule
