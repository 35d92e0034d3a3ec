// forward_differencer × series, exponent_rom and color_sum: a span in, one pixel a clock out.
//
// A span is taken when span_valid and span_ready; its first pixel is at the output LATENCY clocks
// later, and spans follow each other without a bubble. Each stage holds while the next one is full
// and moves on when it is not, so a stall at the output closes bubbles before it reaches the input.
// Channel 0 is in the low bits of every packed port. span_length is at least 1. The table is loaded
// through rom_*, one word of every channel a clock, while no pixel is in flight.
`include "constants.svh"

module pixel_datapath #(
    parameter int CHANNELS           = 1,   // 1 or 3
    parameter int DIFFUSE_FRACTION   = 16,  // below one output LSB
    parameter int SPECULAR_FRACTION  = 12,  // below one ROM address
    parameter int ROM_ADDRESS_BITS   = 10,
    parameter int ROM_DATA_BITS      = 8,
    parameter int GATE               = `PHONGPIPE_GATE_DIFFUSE,
    localparam int DIFFUSE_WIDTH  = 1 + `PHONGPIPE_GUARD_BITS
                                  + `PHONGPIPE_OUTPUT_BITS + DIFFUSE_FRACTION,
    localparam int SPECULAR_WIDTH = 1 + `PHONGPIPE_GUARD_BITS + ROM_ADDRESS_BITS
                                  + SPECULAR_FRACTION,
    localparam int X_BITS         = `PHONGPIPE_COORDINATE_BITS,
    localparam int LENGTH_BITS    = `PHONGPIPE_LENGTH_BITS,
    localparam int COLOR_BITS     = `PHONGPIPE_OUTPUT_BITS
) (
    input logic clk,
    input logic reset,  // synchronous; drops every pixel in flight, keeps the table

    input  logic                                span_valid,
    output logic                                span_ready,
    input  logic [                  X_BITS-1:0] span_x,
    input  logic [                  X_BITS-1:0] span_y,
    input  logic [             LENGTH_BITS-1:0] span_length,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_diffuse_v,   // s9.DIFFUSE_FRACTION, LSB
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_diffuse_d1,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_diffuse_d2,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_level,       // ambient + ½, same format
    input  logic [        SPECULAR_WIDTH-1:0] span_specular_v,  // address.SPECULAR_FRACTION
    input  logic [        SPECULAR_WIDTH-1:0] span_specular_d1,
    input  logic [        SPECULAR_WIDTH-1:0] span_specular_d2,
    input  logic [         DIFFUSE_WIDTH-1:0] span_gate_v,      // N·L, where GATE_SERIES
    input  logic [         DIFFUSE_WIDTH-1:0] span_gate_d1,
    input  logic [         DIFFUSE_WIDTH-1:0] span_gate_d2,

    input logic                              rom_write,
    input logic [      ROM_ADDRESS_BITS-1:0] rom_address,
    input logic [CHANNELS*ROM_DATA_BITS-1:0] rom_data,

    output logic                           pixel_valid,
    input  logic                           pixel_ready,
    output logic [             X_BITS-1:0] pixel_x,
    output logic [             X_BITS-1:0] pixel_y,
    output logic [CHANNELS*COLOR_BITS-1:0] pixel_color
);
  // No such module: an illegal parameter stops elaboration in every tool, by this name.
  if ((CHANNELS != 1 && CHANNELS != 3)
      || DIFFUSE_FRACTION < `PHONGPIPE_MIN_DIFFUSE_FRACTION
      || DIFFUSE_FRACTION > `PHONGPIPE_MAX_DIFFUSE_FRACTION
      || SPECULAR_FRACTION < `PHONGPIPE_MIN_SPECULAR_FRACTION
      || SPECULAR_FRACTION > `PHONGPIPE_MAX_SPECULAR_FRACTION
      || ROM_ADDRESS_BITS < `PHONGPIPE_MIN_ROM_ADDRESS_BITS
      || ROM_ADDRESS_BITS > `PHONGPIPE_MAX_ROM_ADDRESS_BITS
      || ROM_DATA_BITS < `PHONGPIPE_MIN_ROM_DATA_BITS
      || ROM_DATA_BITS > `PHONGPIPE_MAX_ROM_DATA_BITS
      || GATE < `PHONGPIPE_GATE_OFF || GATE > `PHONGPIPE_GATE_SERIES) begin : illegal
    pixel_datapath_parameter_out_of_range stop ();
  end

  // Stages: fd steps the series; 1 compares and forms the address; 2 reads the table and clamps;
  // the output stage adds and saturates.
  logic fd_valid, s1_valid, s2_valid;
  logic [LENGTH_BITS-1:0] fd_remaining;
  logic [X_BITS-1:0] fd_x, fd_y, s1_x, s1_y, s2_x, s2_y;

  wire out_ready = !pixel_valid || pixel_ready;
  wire s2_ready = !s2_valid || out_ready;
  wire s1_ready = !s1_valid || s2_ready;
  wire fd_last = fd_remaining == 1;
  wire fd_step = fd_valid && s1_ready;
  wire [2:0] enable = {out_ready, s2_ready, s1_ready};
  wire load = span_valid && span_ready;

  assign span_ready = !fd_valid || (s1_ready && fd_last);

  always_ff @(posedge clk) begin
    if (load) begin
      fd_x <= span_x;
      fd_y <= span_y;
      fd_remaining <= span_length;
    end else if (fd_step) begin
      fd_x <= fd_x + 1'b1;
      fd_remaining <= fd_remaining - 1'b1;
    end
    if (s1_ready) {s1_x, s1_y} <= {fd_x, fd_y};
    if (s2_ready) {s2_x, s2_y} <= {s1_x, s1_y};
    if (out_ready) {pixel_x, pixel_y} <= {s2_x, s2_y};

    if (reset) begin
      {fd_valid, s1_valid, s2_valid, pixel_valid} <= '0;
    end else begin
      fd_valid <= load || (fd_valid && !(s1_ready && fd_last));
      if (s1_ready) s1_valid <= fd_valid;
      if (s2_ready) s2_valid <= s1_valid;
      if (out_ready) pixel_valid <= s2_valid;
    end
  end

  logic [SPECULAR_WIDTH-1:0] fd_specular_v;
  forward_differencer #(
      .WIDTH(SPECULAR_WIDTH)
  ) specular_series (
      .clk,
      .load,
      .step(fd_step),
      .start_v(span_specular_v),
      .start_d1(span_specular_d1),
      .start_d2(span_specular_d2),
      .v(fd_specular_v)
  );

  logic [CHANNELS*ROM_DATA_BITS-1:0] s2_words;
  exponent_rom #(
      .VALUE_WIDTH (SPECULAR_WIDTH),
      .ADDRESS_BITS(ROM_ADDRESS_BITS),
      .WORD_BITS   (CHANNELS * ROM_DATA_BITS)
  ) rom (
      .clk,
      .address_enable(s1_ready),
      .read_enable(s2_ready),
      .v(fd_specular_v),
      .word(s2_words),
      .write(rom_write),
      .write_address(rom_address),
      .write_word(rom_data)
  );

  logic [CHANNELS-1:0] s1_lit;  // channel by channel: N·L > 0 as its diffuse series has it
  logic s1_open;                // whether the highlight counts
  logic s2_open;
  always_ff @(posedge clk) if (s2_ready) s2_open <= s1_open;

  logic [CHANNELS*DIFFUSE_WIDTH-1:0] fd_level;
  always_ff @(posedge clk) if (load) fd_level <= span_level;

  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    logic [DIFFUSE_WIDTH-1:0] fd_diffuse_v;
    forward_differencer #(
        .WIDTH(DIFFUSE_WIDTH)
    ) diffuse_series (
        .clk,
        .load,
        .step(fd_step),
        .start_v(span_diffuse_v[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .start_d1(span_diffuse_d1[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .start_d2(span_diffuse_d2[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .v(fd_diffuse_v)
    );
    color_sum #(
        .DIFFUSE_WIDTH(DIFFUSE_WIDTH),
        .WORD_BITS(ROM_DATA_BITS)
    ) summation (
        .clk,
        .enable,
        .diffuse(fd_diffuse_v),
        .level(fd_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .lit(s1_lit[c]),
        .highlight_open(s2_open),
        .word(s2_words[c*ROM_DATA_BITS+:ROM_DATA_BITS]),
        .color(pixel_color[c*COLOR_BITS+:COLOR_BITS])
    );
  end

  if (GATE == `PHONGPIPE_GATE_SERIES) begin : gate
    logic [DIFFUSE_WIDTH-1:0] fd_gate_v;
    forward_differencer #(
        .WIDTH(DIFFUSE_WIDTH)
    ) gate_series (
        .clk,
        .load,
        .step(fd_step),
        .start_v(span_gate_v),
        .start_d1(span_gate_d1),
        .start_d2(span_gate_d2),
        .v(fd_gate_v)
    );
    always_ff @(posedge clk) if (s1_ready) s1_open <= $signed(fd_gate_v) > 0;
    wire unused_lit = &{1'b0, s1_lit};
  end else begin : no_gate_series
    assign s1_open = GATE == `PHONGPIPE_GATE_OFF || |s1_lit;
    wire unused_gate = &{1'b0, span_gate_v, span_gate_d1, span_gate_d2};
  end
endmodule
