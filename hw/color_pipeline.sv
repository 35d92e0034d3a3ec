// The colour of a pixel from the values of its series: exponent_rom, the gate of the highlight, color_sum and
// depth_cue. A pixel a clock. Nothing waits.
//
// Stages by the number in a register's name: 3 the level and what else a span keeps for all its pixels; 4 the
// series; 5 address, comparison of the low bits; 6 place in the table, lit; 7 word read, clamped; 8 word; 9
// gated word; 10 sum. Depth cueing is 11 to 16. last_color is of stage 10, or 16 with DEPTH_CUE.
`include "constants.svh"

module color_pipeline #(
    parameter int CHANNELS         = 1,
    parameter int DIFFUSE          = 1,
    parameter int SPECULAR         = 1,
    parameter int DEPTH_CUE        = 0,
    parameter int DIFFUSE_WIDTH    = 26,
    parameter int SPECULAR_WIDTH   = 24,
    parameter int ROM_ADDRESS_BITS = 10,
    parameter int ROM_DATA_BITS    = 8,
    parameter int GATE             = `PHONGPIPE_GATE_DIFFUSE,
    parameter int SPECULAR_GUARD   = `PHONGPIPE_GUARD_BITS,
    parameter int ROM_LAYOUT       = `PHONGPIPE_LAYOUT_PLAIN,
    parameter int ROM_OCTAVES      = 4,
    localparam int COLOR_BITS      = `PHONGPIPE_OUTPUT_BITS,
    localparam int CUE_WIDTH       = `PHONGPIPE_CUE_WIDTH
) (
    input logic clk,

    input logic [CHANNELS*DIFFUSE_WIDTH-1:0] s3_level,
    input logic                              s3_highlight,   // whether the word counts
    input logic                              s3_first_pass,
    input logic [CHANNELS*DIFFUSE_WIDTH-1:0] s4_diffuse,     // where DIFFUSE; else the light is the level
    input logic [        SPECULAR_WIDTH-1:0] s4_specular,
    input logic [         DIFFUSE_WIDTH-1:0] s4_gate,        // N·L, where GATE_SERIES
    input logic [             CUE_WIDTH-1:0] s4_cue,         // where DEPTH_CUE
    input logic [   CHANNELS*COLOR_BITS-1:0] cue_color,

    input logic                              rom_write,
    input logic [      ROM_ADDRESS_BITS-1:0] rom_address,
    input logic [CHANNELS*ROM_DATA_BITS-1:0] rom_data,

    output logic [CHANNELS*COLOR_BITS-1:0] last_color
);
  // No such modules: an illegal parameter stops elaboration in every tool, at a name that says which.
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

  logic [6:4] highlight;
  always_ff @(posedge clk) highlight <= {highlight[5:4], s3_highlight};

  logic [CHANNELS*ROM_DATA_BITS-1:0] s8_words, s8_increments;
  logic [CHANNELS-1:0] s6_lit;  // channel by channel: N·L > 0 as its diffuse series has it
  logic s8_open;                // whether the highlight counts
  if (SPECULAR != 0) begin : specular
    exponent_rom #(
        .VALUE_WIDTH (SPECULAR_WIDTH),
        .GUARD_BITS  (SPECULAR_GUARD),
        .ADDRESS_BITS(ROM_ADDRESS_BITS),
        .WORD_BITS   (CHANNELS * ROM_DATA_BITS),
        .LAYOUT      (ROM_LAYOUT),
        .OCTAVES     (ROM_OCTAVES)
    ) rom (
        .clk,
        .s4_v(s4_specular),
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
      logic s5_zero;
      logic s5_negative;
      always_ff @(posedge clk) begin
        s5_negative <= s4_gate[DIFFUSE_WIDTH-1];
        s5_zero <= s4_gate == '0;
        s6_facing <= !s5_negative && !s5_zero;
      end
      wire unused_lit = &{1'b0, s6_lit};
    end else begin : no_gate_series
      assign s6_facing = GATE == `PHONGPIPE_GATE_OFF || |s6_lit;
      wire unused_gate = &{1'b0, s4_gate};
    end
  end else begin : no_specular
    assign {s8_words, s8_increments} = '0;
    assign s8_open = 1'b0;
    wire unused = &{1'b0, highlight[6], s4_specular, s4_gate, rom_write, rom_address, rom_data, s6_lit};
  end

  localparam int SUM_BITS = `PHONGPIPE_GUARD_BITS + COLOR_BITS + 1;
  logic [CHANNELS*SUM_BITS-1:0] s10_sum;
  logic [CHANNELS*COLOR_BITS-1:0] s10_color;
  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    logic [DIFFUSE_WIDTH-1:0] s4_light;
    if (DIFFUSE != 0) begin : lit
      assign s4_light = s4_diffuse[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH];
    end else begin : unlit
      always_ff @(posedge clk) s4_light <= s3_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH];
    end
    color_sum #(
        .DIFFUSE_WIDTH(DIFFUSE_WIDTH),
        .WORD_BITS(ROM_DATA_BITS)
    ) summation (
        .clk,
        .s4_diffuse(s4_light),
        .s3_level(s3_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .s6_lit(s6_lit[c]),
        .s8_open,
        .s8_word(s8_words[c*ROM_DATA_BITS+:ROM_DATA_BITS]),
        .s8_increment(s8_increments[c*ROM_DATA_BITS+:ROM_DATA_BITS]),
        .s10_sum(s10_sum[c*SUM_BITS+:SUM_BITS]),
        .s10_color(s10_color[c*COLOR_BITS+:COLOR_BITS])
    );
  end
  if (DIFFUSE == 0) begin : level_alone
    wire unused = &{1'b0, s4_diffuse};
  end

  if (DEPTH_CUE != 0) begin : cueing
    localparam int FACTOR_BITS = `PHONGPIPE_CUE_FACTOR_BITS;
    localparam int DROPPED = `PHONGPIPE_CUE_FRACTION - FACTOR_BITS;
    logic [10:4] first_pass;  // of the span
    logic [FACTOR_BITS:0] s5_factor, s6_factor, s7_factor, s8_factor, s9_factor, s10_factor;
    wire above = |s4_cue[CUE_WIDTH-2:`PHONGPIPE_CUE_FRACTION];
    wire unused_fraction = &{1'b0, s4_cue[DROPPED-1:0], s10_color};

    always_ff @(posedge clk) begin
      first_pass <= {first_pass[9:4], s3_first_pass};
      s5_factor <= s4_cue[CUE_WIDTH-1] ? '0 : above ? {1'b1, {FACTOR_BITS{1'b0}}}
                                                    : {1'b0, s4_cue[DROPPED+:FACTOR_BITS]};
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
    wire unused = &{1'b0, s3_first_pass, s4_cue, cue_color, s10_sum};
  end
endmodule
