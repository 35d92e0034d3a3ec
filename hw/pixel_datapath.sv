// A span in, one pixel a clock out: span_control, forward_differencer × series, color_pipeline, and pixel_queue
// behind them.
//
// DIFFUSE, SPECULAR and DEPTH_CUE leave out the blocks of effects that a scene has not; without its
// diffuse series a channel's light is the level.
//
// A span is taken when span_valid and span_ready; its first pixel is at the output PHONGPIPE_DATAPATH_LATENCY
// clocks later, and PHONGPIPE_DEPTH_CUE_LATENCY more with DEPTH_CUE. Spans follow each other without a bubble,
// those of one pixel, too. A pixel enters the pipeline only if pixel_queue has room for it, and then moves on
// a stage a clock: nothing in the pipeline waits for the output.
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
    parameter int X_STEP             = 1,   // from a pixel to the next: lanes of a wide datapath take turns
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

  // Stages, by the number in a register's name or the index of its bit: 0 the input; 1 the terms of the series;
  // 2 to 4 the series; the others are those of color_pipeline. The last one is written to the queue.
  localparam int LAST = `PHONGPIPE_DATAPATH_LATENCY - 3 + (DEPTH_CUE != 0 ? `PHONGPIPE_DEPTH_CUE_LATENCY : 0);

  logic [LAST:0] valid;
  logic [3:0] first;    // pixel of a span
  logic [2:1] restart;  // first or second pixel of a span
  logic after_first;    // the last pixel that left stage 0 was the first of a span

  wire unused_control = &{1'b0, first, restart};  // without any series

  logic room, load, enter;
  span_control control (
      .clk,
      .reset,
      .room,
      .span_valid,
      .span_length,
      .span_ready,
      .load,
      .enter
  );

  always_ff @(posedge clk) begin
    first <= {first[2:0], load};
    restart <= {restart[1], first[0] || after_first};
    if (valid[0]) after_first <= first[0];
    if (reset) valid <= '0;
    else valid <= {valid[LAST-1:0], enter};
  end

  logic [CHANNELS*DIFFUSE_WIDTH-1:0] s1_level, s2_level, s3_level;
  logic [X_BITS-1:0] s0_x_term, s1_x, s1_y;
  logic s1_highlight, s1_first_pass;
  logic [3:2] highlight, first_pass;  // of the span
  span_register #(
      .WIDTH(X_BITS + 1 + 1 + CHANNELS * DIFFUSE_WIDTH)
  ) of_span (
      .clk,
      .load(first[0]),
      .start({span_y, span_highlight, span_first_pass, span_level}),
      .value({s1_y, s1_highlight, s1_first_pass, s1_level})
  );
  always_ff @(posedge clk) begin
    // A multiplexer in the form that yosys does not turn into a synchronous set and reset.
    s0_x_term <= (span_x & {X_BITS{load}}) | (X_BITS'(X_STEP) & {X_BITS{!load}});
    if (valid[0]) s1_x <= first[0] ? s0_x_term : s1_x + s0_x_term;
    highlight <= {highlight[2], s1_highlight};
    first_pass <= {first_pass[2], s1_first_pass};
    s2_level <= s1_level;
    s3_level <= s2_level;
  end

  logic [CHANNELS*DIFFUSE_WIDTH-1:0] s4_diffuse;
  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    if (DIFFUSE != 0) begin : diffuse
      forward_differencer #(
          .WIDTH(DIFFUSE_WIDTH)
      ) diffuse_series (
          .clk,
          .stepping(span_step_diffuse),
          .start_v(span_diffuse_v[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .start_d1(span_diffuse_d1[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .start_d2(span_diffuse_d2[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .valid(valid[3:0]),
          .restart,
          .first,
          .s4_v(s4_diffuse[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH])
      );
    end
  end
  if (DIFFUSE == 0) begin : unlit
    assign s4_diffuse = '0;
    wire unused = &{1'b0, span_step_diffuse, span_diffuse_v, span_diffuse_d1, span_diffuse_d2};
  end

  logic [SPECULAR_WIDTH-1:0] s4_specular;
  if (SPECULAR != 0) begin : specular
    forward_differencer #(
        .WIDTH(SPECULAR_WIDTH)
    ) specular_series (
        .clk,
        .stepping(span_step_specular),
        .start_v(span_specular_v),
        .start_d1(span_specular_d1),
        .start_d2(span_specular_d2),
        .valid(valid[3:0]),
        .restart,
        .first,
        .s4_v(s4_specular)
    );
  end else begin : no_specular
    assign s4_specular = '0;
    wire unused = &{1'b0, span_step_specular, span_specular_v, span_specular_d1, span_specular_d2};
  end

  logic [DIFFUSE_WIDTH-1:0] s4_gate;
  if (SPECULAR != 0 && GATE == `PHONGPIPE_GATE_SERIES) begin : gate
    forward_differencer #(
        .WIDTH(DIFFUSE_WIDTH)
    ) gate_series (
        .clk,
        .stepping(span_step_diffuse),
        .start_v(span_gate_v),
        .start_d1(span_gate_d1),
        .start_d2(span_gate_d2),
        .valid(valid[3:0]),
        .restart,
        .first,
        .s4_v(s4_gate)
    );
  end else begin : no_gate_series
    assign s4_gate = '0;
    wire unused = &{1'b0, span_gate_v, span_gate_d1, span_gate_d2};
  end

  logic [CUE_WIDTH-1:0] s4_cue;
  if (DEPTH_CUE != 0) begin : cueing
    forward_differencer #(
        .WIDTH(CUE_WIDTH)
    ) cue_series (
        .clk,
        .stepping(1'b1),
        .start_v(span_cue_v),
        .start_d1(span_cue_d1),
        .start_d2({CUE_WIDTH{1'b0}}),
        .valid(valid[3:0]),
        .restart,
        .first,
        .s4_v(s4_cue)
    );
  end else begin : no_cueing
    assign s4_cue = '0;
    wire unused = &{1'b0, span_cue_v, span_cue_d1};
  end

  logic [CHANNELS*COLOR_BITS-1:0] last_color;
  color_pipeline #(
      .CHANNELS(CHANNELS),
      .DIFFUSE(DIFFUSE),
      .SPECULAR(SPECULAR),
      .DEPTH_CUE(DEPTH_CUE),
      .DIFFUSE_WIDTH(DIFFUSE_WIDTH),
      .SPECULAR_WIDTH(SPECULAR_WIDTH),
      .ROM_ADDRESS_BITS(ROM_ADDRESS_BITS),
      .ROM_DATA_BITS(ROM_DATA_BITS),
      .GATE(GATE),
      .SPECULAR_GUARD(SPECULAR_GUARD),
      .ROM_LAYOUT(ROM_LAYOUT),
      .ROM_OCTAVES(ROM_OCTAVES)
  ) color (
      .clk,
      .s3_level,
      .s3_highlight(highlight[3]),
      .s3_first_pass(first_pass[3]),
      .s4_diffuse,
      .s4_specular,
      .s4_gate,
      .s4_cue,
      .cue_color,
      .rom_write,
      .rom_address,
      .rom_data,
      .last_color
  );

  pixel_queue #(
      .PLACE_BITS(2 * X_BITS),
      .COLOR_BITS(CHANNELS * COLOR_BITS)
  ) queue (
      .clk,
      .reset,
      .room,
      .entered(valid[0]),
      .place_valid(valid[1]),
      .place({s1_x, s1_y}),
      .color_valid(valid[LAST]),
      .color(last_color),
      .pixel_valid,
      .pixel_ready,
      .pixel_place({pixel_x, pixel_y}),
      .pixel_color
  );
endmodule
