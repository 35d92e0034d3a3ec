// A span in, one pixel a clock out: forward_differencer × series, exponent_rom, color_sum and depth_cue, and
// pixel_queue behind them.
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

  // Stages, by the number in a register's name or the index of its bit: 0 the input; 1 the terms of the series;
  // 2 to 4 the series; 5 address, comparison of the low bits; 6 place in the table, lit; 7 word read, clamped; 8
  // word; 9 gated word; 10 sum. Depth cueing is 11 to 16. The last one is written to the queue.
  localparam int LAST = `PHONGPIPE_DATAPATH_LATENCY - 3 + (DEPTH_CUE != 0 ? `PHONGPIPE_DEPTH_CUE_LATENCY : 0);

  logic [LAST:0] valid;
  logic [3:0] first;    // pixel of a span
  logic [2:1] restart;  // first or second pixel of a span
  logic after_first;    // the last pixel that left stage 0 was the first of a span

  wire unused_control = &{1'b0, first, restart};  // without any series

  // `remaining` pixels of the span, the last one that entered among them; `ending`: they are 2. `open`: the
  // next one is of another span.
  logic room, open, ending;
  logic [LENGTH_BITS-1:0] remaining;
  assign span_ready = room && open;
  wire load = span_ready && span_valid;
  wire enter = load || (room && !open);

  always_ff @(posedge clk) begin
    if (room) begin
      remaining <= open ? span_length : remaining - 1'b1;
      ending <= open ? span_length == 2 : remaining == 3;
    end
    first <= {first[2:0], load};
    restart <= {restart[1], first[0] || after_first};
    if (valid[0]) after_first <= first[0];
    if (reset) begin
      valid <= '0;
      open <= 1'b1;
    end else begin
      valid <= {valid[LAST-1:0], enter};
      open <= open ? !load || span_length == 1 : room && ending;
    end
  end

  logic [CHANNELS*DIFFUSE_WIDTH-1:0] s1_level, s2_level, s3_level;
  logic [X_BITS-1:0] s0_x_term, s1_x, s1_y;
  logic s1_highlight, s1_first_pass;
  logic [6:2] highlight;  // of the span: whether the word counts
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
    s0_x_term <= (span_x & {X_BITS{load}}) | X_BITS'(!load);
    if (valid[0]) s1_x <= first[0] ? s0_x_term : s1_x + s0_x_term;
    highlight <= {highlight[5:2], s1_highlight};
    s2_level <= s1_level;
    s3_level <= s2_level;
  end

  logic [CHANNELS*ROM_DATA_BITS-1:0] s8_words, s8_increments;
  logic [CHANNELS-1:0] s6_lit;  // channel by channel: N·L > 0 as its diffuse series has it
  logic s8_open;                // whether the highlight counts
  if (SPECULAR != 0) begin : specular
    logic [SPECULAR_WIDTH-1:0] s4_v;
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
        .s4_v
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
        .s4_v,
        .s8_word(s8_words),
        .s8_increment(s8_increments),
        .write(rom_write),
        .write_address(rom_address),
        .write_word(rom_data)
    );
    logic s6_facing, s7_open;
    always_ff @(posedge clk) begin
      s7_open <= s6_facing && highlight[6];
      s8_open <= s7_open;
    end
    if (GATE == `PHONGPIPE_GATE_SERIES) begin : gate
      logic [DIFFUSE_WIDTH-1:0] s4_gate;
      logic s5_zero;
      logic s5_negative;
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
      always_ff @(posedge clk) begin
        s5_negative <= s4_gate[DIFFUSE_WIDTH-1];
        s5_zero <= s4_gate == '0;
        s6_facing <= !s5_negative && !s5_zero;
      end
      wire unused_lit = &{1'b0, s6_lit};
    end else begin : no_gate_series
      assign s6_facing = GATE == `PHONGPIPE_GATE_OFF || |s6_lit;
      wire unused_gate = &{1'b0, span_gate_v, span_gate_d1, span_gate_d2};
    end
  end else begin : no_specular
    assign {s8_words, s8_increments} = '0;
    assign s8_open = 1'b0;
    wire unused = &{1'b0, highlight[6], span_step_specular, span_specular_v, span_specular_d1, span_specular_d2,
                    span_gate_v, span_gate_d1, span_gate_d2, rom_write, rom_address, rom_data, s6_lit};
  end

  localparam int SUM_BITS = `PHONGPIPE_GUARD_BITS + COLOR_BITS + 1;
  logic [CHANNELS*SUM_BITS-1:0] s10_sum;
  logic [CHANNELS*COLOR_BITS-1:0] s10_color, last_color;
  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    logic [DIFFUSE_WIDTH-1:0] s4_diffuse;
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
          .s4_v(s4_diffuse)
      );
    end else begin : no_diffuse
      always_ff @(posedge clk) s4_diffuse <= s3_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH];
    end
    color_sum #(
        .DIFFUSE_WIDTH(DIFFUSE_WIDTH),
        .WORD_BITS(ROM_DATA_BITS)
    ) summation (
        .clk,
        .s4_diffuse,
        .s3_level(s3_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .s6_lit(s6_lit[c]),
        .s8_open,
        .s8_word(s8_words[c*ROM_DATA_BITS+:ROM_DATA_BITS]),
        .s8_increment(s8_increments[c*ROM_DATA_BITS+:ROM_DATA_BITS]),
        .s10_sum(s10_sum[c*SUM_BITS+:SUM_BITS]),
        .s10_color(s10_color[c*COLOR_BITS+:COLOR_BITS])
    );
  end
  if (DIFFUSE == 0) begin : unlit
    wire unused = &{1'b0, span_step_diffuse, span_diffuse_v, span_diffuse_d1, span_diffuse_d2};
  end

  if (DEPTH_CUE != 0) begin : cueing
    localparam int FACTOR_BITS = `PHONGPIPE_CUE_FACTOR_BITS;
    localparam int DROPPED = `PHONGPIPE_CUE_FRACTION - FACTOR_BITS;
    logic [CUE_WIDTH-1:0] s4_v;
    logic [10:2] first_pass;  // of the span
    logic [FACTOR_BITS:0] s5_factor, s6_factor, s7_factor, s8_factor, s9_factor, s10_factor;
    wire above = |s4_v[CUE_WIDTH-2:`PHONGPIPE_CUE_FRACTION];
    wire unused_fraction = &{1'b0, s4_v[DROPPED-1:0], s10_color};

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
        .s4_v
    );
    always_ff @(posedge clk) begin
      first_pass <= {first_pass[9:2], s1_first_pass};
      s5_factor <= s4_v[CUE_WIDTH-1] ? '0 : above ? {1'b1, {FACTOR_BITS{1'b0}}}
                                                  : {1'b0, s4_v[DROPPED+:FACTOR_BITS]};
      {s6_factor, s7_factor, s8_factor, s9_factor, s10_factor} <=
          {s5_factor, s6_factor, s7_factor, s8_factor, s9_factor};
    end
    for (genvar c = 0; c < CHANNELS; c++) begin : channel
      depth_cue #(
          .SUM_BITS(SUM_BITS)
      ) multiplier (
          .clk,
          .s10_sum(s10_sum[c*SUM_BITS+:SUM_BITS]),
          .s10_cue(first_pass[10] ? cue_color[c*COLOR_BITS+:COLOR_BITS] : '0),
          .s10_factor,
          .s16_color(last_color[c*COLOR_BITS+:COLOR_BITS])
      );
    end
  end else begin : no_cueing
    assign last_color = s10_color;
    wire unused = &{1'b0, s1_first_pass, span_cue_v, span_cue_d1, cue_color, s10_sum};
  end

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
