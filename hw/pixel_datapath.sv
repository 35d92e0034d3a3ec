// forward_differencer × series, exponent_rom, color_sum and depth_cue: a span in, one pixel a clock out.
//
// DIFFUSE, SPECULAR and DEPTH_CUE leave out the blocks of effects that a scene has not; without its
// diffuse series a channel's light is the level.
//
// A span is taken when span_valid and span_ready; its first pixel is at the output PHONGPIPE_DATAPATH_LATENCY
// clocks later, and PHONGPIPE_DEPTH_CUE_LATENCY more with DEPTH_CUE. Spans follow each other without a bubble.
// Each stage holds while the next one is full and moves on when it is not, so a stall at the output closes
// bubbles before it reaches the input.
// Channel 0 is in the low bits of every packed port. span_length is at least 1. The table is loaded
// through rom_*, one word of every channel a clock, while no pixel is in flight. cue_color must not change
// while a pixel is in flight.
`include "constants.svh"

module pixel_datapath #(
    parameter int CHANNELS           = 1,   // 1 or 3
    parameter int DIFFUSE            = 1,
    parameter int SPECULAR           = 1,
    parameter int DEPTH_CUE          = 0,
    parameter int DIFFUSE_FRACTION   = 16,  // below one output LSB
    parameter int SPECULAR_FRACTION  = 12,  // below one ROM address
    parameter int ROM_ADDRESS_BITS   = 10,
    parameter int ROM_DATA_BITS      = 8,
    parameter int GATE               = `PHONGPIPE_GATE_DIFFUSE,
    parameter int SPECULAR_GUARD     = `PHONGPIPE_GUARD_BITS,
    parameter int ROM_LAYOUT         = `PHONGPIPE_LAYOUT_PLAIN,
    parameter int ROM_OCTAVES        = 4,   // of the octave layouts
    localparam int DIFFUSE_WIDTH  = 1 + `PHONGPIPE_GUARD_BITS
                                  + `PHONGPIPE_OUTPUT_BITS + DIFFUSE_FRACTION,
    localparam int SPECULAR_WIDTH = 1 + SPECULAR_GUARD + ROM_ADDRESS_BITS + SPECULAR_FRACTION,
    localparam int X_BITS         = `PHONGPIPE_COORDINATE_BITS,
    localparam int LENGTH_BITS    = `PHONGPIPE_LENGTH_BITS,
    localparam int COLOR_BITS     = `PHONGPIPE_OUTPUT_BITS,
    localparam int CUE_WIDTH      = `PHONGPIPE_CUE_WIDTH
) (
    input logic clk,
    input logic reset,  // synchronous; drops every pixel in flight, keeps the table

    input  logic                                span_valid,
    output logic                                span_ready,
    input  logic [                  X_BITS-1:0] span_x,
    input  logic [                  X_BITS-1:0] span_y,
    input  logic [             LENGTH_BITS-1:0] span_length,
    input  logic                                span_first_pass,           // of the first light: fades to cue_color
    input  logic                                span_step_diffuse,   // else diffuse (and gate) stay as they start
    input  logic                                span_step_specular,
    input  logic                                span_highlight,      // else the word does not count
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
    input  logic [             CUE_WIDTH-1:0] span_cue_v,       // s11.CUE_FRACTION, where DEPTH_CUE
    input  logic [             CUE_WIDTH-1:0] span_cue_d1,
    input  logic [   CHANNELS*COLOR_BITS-1:0] cue_color,

    input logic                              rom_write,
    input logic [      ROM_ADDRESS_BITS-1:0] rom_address,
    input logic [CHANNELS*ROM_DATA_BITS-1:0] rom_data,

    output logic                           pixel_valid,
    input  logic                           pixel_ready,
    output logic [             X_BITS-1:0] pixel_x,
    output logic [             X_BITS-1:0] pixel_y,
    output logic [CHANNELS*COLOR_BITS-1:0] pixel_color
);
  // No such modules: an illegal parameter stops elaboration in every tool, at a name that says which.
  `PHONGPIPE_CHECK_PARAMETERS
  if (CHANNELS != 1 && CHANNELS != 3) begin : CHANNELS_out_of_range
    CHANNELS_must_be_1_or_3 stop ();
  end
  if (GATE < `PHONGPIPE_GATE_OFF || GATE > `PHONGPIPE_GATE_SERIES) begin : GATE_out_of_range
    GATE_must_be_0_to_2 stop ();
  end
  if (ROM_LAYOUT < `PHONGPIPE_LAYOUT_PLAIN || ROM_LAYOUT > `PHONGPIPE_LAYOUT_BIPARTITE) begin : layout_out_of_range
    ROM_LAYOUT_must_be_0_to_2 stop ();
  end
  if (SPECULAR_GUARD < 1 || SPECULAR_GUARD > `PHONGPIPE_SPECULAR_GUARD_BITS) begin : guard_out_of_range
    SPECULAR_GUARD_must_be_1_to_12 stop ();
  end
  if (SPECULAR != 0 && DIFFUSE == 0 && GATE == `PHONGPIPE_GATE_DIFFUSE) begin : GATE_without_series
    GATE_diffuse_needs_DIFFUSE stop ();
  end

  // Stages: fd steps the series; 1 compares and forms the address; 2 reads the table and clamps; 3 adds,
  // and the output stage is 3 or, where there is depth cueing, what follows it.
  logic fd_valid, s1_valid, s2_valid, s3_valid;
  logic [LENGTH_BITS-1:0] fd_remaining;
  logic [X_BITS-1:0] fd_x, fd_y, s1_x, s1_y, s2_x, s2_y, s3_x, s3_y;
  logic fd_step_diffuse, fd_step_specular, fd_highlight;

  logic out_ready;  // of what follows stage 3
  wire s3_ready = !s3_valid || out_ready;
  wire s2_ready = !s2_valid || s3_ready;
  wire s1_ready = !s1_valid || s2_ready;
  wire fd_last = fd_remaining == 1;
  wire fd_step = fd_valid && s1_ready;
  wire [2:0] enable = {s3_ready, s2_ready, s1_ready};
  wire load = span_valid && span_ready;

  assign span_ready = !fd_valid || (s1_ready && fd_last);

  always_ff @(posedge clk) begin
    if (load) begin
      fd_x <= span_x;
      fd_y <= span_y;
      fd_remaining <= span_length;
      fd_step_diffuse <= span_step_diffuse;
      fd_step_specular <= span_step_specular;
      fd_highlight <= span_highlight;
    end else if (fd_step) begin
      fd_x <= fd_x + 1'b1;
      fd_remaining <= fd_remaining - 1'b1;
    end
    if (s1_ready) {s1_x, s1_y} <= {fd_x, fd_y};
    if (s2_ready) {s2_x, s2_y} <= {s1_x, s1_y};
    if (s3_ready) {s3_x, s3_y} <= {s2_x, s2_y};

    if (reset) begin
      // A constant that no longer is the number of stages is a width mismatch here.
      {fd_valid, s1_valid, s2_valid, s3_valid} <= {`PHONGPIPE_DATAPATH_LATENCY{1'b0}};
    end else begin
      fd_valid <= load || (fd_valid && !(s1_ready && fd_last));
      if (s1_ready) s1_valid <= fd_valid;
      if (s2_ready) s2_valid <= s1_valid;
      if (s3_ready) s3_valid <= s2_valid;
    end
  end

  logic [CHANNELS*ROM_DATA_BITS-1:0] s2_words, s2_increments;
  logic [CHANNELS-1:0] s1_lit;  // channel by channel: N·L > 0 as its diffuse series has it
  logic s2_open;                // whether the highlight counts
  if (SPECULAR != 0) begin : specular
    logic [SPECULAR_WIDTH-1:0] fd_specular_v;
    forward_differencer #(
        .WIDTH(SPECULAR_WIDTH)
    ) specular_series (
        .clk,
        .load,
        .step(fd_step && fd_step_specular),
        .start_v(span_specular_v),
        .start_d1(span_specular_d1),
        .start_d2(span_specular_d2),
        .v(fd_specular_v)
    );
    exponent_rom #(
        .VALUE_WIDTH (SPECULAR_WIDTH),
        .GUARD_BITS  (SPECULAR_GUARD),
        .ADDRESS_BITS(ROM_ADDRESS_BITS),
        .WORD_BITS   (CHANNELS * ROM_DATA_BITS),
        .LAYOUT      (ROM_LAYOUT),
        .OCTAVES     (ROM_OCTAVES)
    ) rom (
        .clk,
        .address_enable(s1_ready),
        .read_enable(s2_ready),
        .v(fd_specular_v),
        .word(s2_words),
        .increment(s2_increments),
        .write(rom_write),
        .write_address(rom_address),
        .write_word(rom_data)
    );
    logic s1_highlight;
    logic s1_open;
    always_ff @(posedge clk) begin
      if (s1_ready) s1_highlight <= fd_highlight;
      if (s2_ready) s2_open <= s1_open && s1_highlight;
    end
    if (GATE == `PHONGPIPE_GATE_SERIES) begin : gate
      logic [DIFFUSE_WIDTH-1:0] fd_gate_v;
      forward_differencer #(
          .WIDTH(DIFFUSE_WIDTH)
      ) gate_series (
          .clk,
          .load,
          .step(fd_step && fd_step_diffuse),
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
  end else begin : no_specular
    assign {s2_words, s2_increments} = '0;
    assign s2_open = 1'b0;
    wire unused = &{1'b0, fd_highlight, fd_step_specular, span_specular_v, span_specular_d1, span_specular_d2,
                    span_gate_v, span_gate_d1, span_gate_d2, rom_write, rom_address, rom_data, s1_lit};
  end

  logic [CHANNELS*DIFFUSE_WIDTH-1:0] fd_level;
  always_ff @(posedge clk) if (load) fd_level <= span_level;

  localparam int SUM_BITS = `PHONGPIPE_GUARD_BITS + COLOR_BITS + 1;
  logic [CHANNELS*SUM_BITS-1:0] s3_sum;
  logic [CHANNELS*COLOR_BITS-1:0] s3_color;
  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    logic [DIFFUSE_WIDTH-1:0] fd_diffuse_v;
    if (DIFFUSE != 0) begin : diffuse
      forward_differencer #(
          .WIDTH(DIFFUSE_WIDTH)
      ) diffuse_series (
          .clk,
          .load,
          .step(fd_step && fd_step_diffuse),
          .start_v(span_diffuse_v[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .start_d1(span_diffuse_d1[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .start_d2(span_diffuse_d2[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .v(fd_diffuse_v)
      );
    end else begin : no_diffuse
      assign fd_diffuse_v = fd_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH];
    end
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
        .word(s2_words[c*ROM_DATA_BITS+:ROM_DATA_BITS] + s2_increments[c*ROM_DATA_BITS+:ROM_DATA_BITS]),
        .sum(s3_sum[c*SUM_BITS+:SUM_BITS]),
        .color(s3_color[c*COLOR_BITS+:COLOR_BITS])
    );
  end
  if (DIFFUSE == 0) begin : unlit
    wire unused = &{1'b0, fd_step_diffuse, span_diffuse_v, span_diffuse_d1, span_diffuse_d2};
  end

  if (DEPTH_CUE != 0) begin : cueing
    localparam int FACTOR_BITS = `PHONGPIPE_CUE_FACTOR_BITS;
    localparam int DROPPED = `PHONGPIPE_CUE_FRACTION - FACTOR_BITS;
    logic s4_valid;
    logic [X_BITS-1:0] s4_x, s4_y;
    logic [CUE_WIDTH-1:0] fd_cue_v;
    logic fd_first_pass, s1_first_pass, s2_first_pass, s3_first_pass;
    logic [FACTOR_BITS:0] s1_factor, s2_factor, s3_factor;
    wire s4_ready = !s4_valid || pixel_ready;
    wire above = |fd_cue_v[CUE_WIDTH-2:`PHONGPIPE_CUE_FRACTION];
    wire unused_fraction = &{1'b0, fd_cue_v[DROPPED-1:0], s3_color};

    forward_differencer #(
        .WIDTH(CUE_WIDTH)
    ) cue_series (
        .clk,
        .load,
        .step(fd_step),
        .start_v(span_cue_v),
        .start_d1(span_cue_d1),
        .start_d2({CUE_WIDTH{1'b0}}),
        .v(fd_cue_v)
    );
    always_ff @(posedge clk) begin
      if (load) fd_first_pass <= span_first_pass;
      if (s1_ready) begin
        s1_factor <= fd_cue_v[CUE_WIDTH-1] ? '0 : above ? {1'b1, {FACTOR_BITS{1'b0}}}
                                                        : {1'b0, fd_cue_v[DROPPED+:FACTOR_BITS]};
        s1_first_pass <= fd_first_pass;
      end
      if (s2_ready) {s2_factor, s2_first_pass} <= {s1_factor, s1_first_pass};
      if (s3_ready) {s3_factor, s3_first_pass} <= {s2_factor, s2_first_pass};
      if (s4_ready) {s4_x, s4_y} <= {s3_x, s3_y};
      if (reset) s4_valid <= 1'b0;
      else if (s4_ready) s4_valid <= s3_valid;
    end
    for (genvar c = 0; c < CHANNELS; c++) begin : channel
      depth_cue #(
          .SUM_BITS(SUM_BITS)
      ) multiplier (
          .clk,
          .enable(s4_ready),
          .sum(s3_sum[c*SUM_BITS+:SUM_BITS]),
          .cue(s3_first_pass ? cue_color[c*COLOR_BITS+:COLOR_BITS] : '0),
          .factor(s3_factor),
          .color(pixel_color[c*COLOR_BITS+:COLOR_BITS])
      );
    end
    assign out_ready = s4_ready;
    assign pixel_valid = s4_valid;
    assign {pixel_x, pixel_y} = {s4_x, s4_y};
  end else begin : no_cueing
    assign out_ready = pixel_ready;
    assign pixel_valid = s3_valid;
    assign {pixel_x, pixel_y} = {s3_x, s3_y};
    assign pixel_color = s3_color;
    wire unused = &{1'b0, span_first_pass, span_cue_v, span_cue_d1, cue_color, s3_sum};
  end
endmodule
