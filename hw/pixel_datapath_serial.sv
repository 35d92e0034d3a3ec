// pixel_datapath for the smallest devices: few LUTs, several clocks a pixel. span_control and
// serial_differencer, then color_pipeline and pixel_queue as in the pipelined datapath.
//
// Parameters and ports are those of pixel_datapath.sv, but for the words of a span. They stay outside until the
// next span is taken, and are read digit by digit, for every pixel anew. span_series and span_digit name a digit
// of the span that was taken last; it may be taken in the same clock. In the next clock the digit is at span_v,
// span_d1 and span_d2, and for a diffuse series at span_level. Digit 0 is the lowest. Words are extended by
// their signs. d2 of the series of depth cueing is 0.
// Series have the numbers from 0 on: specular, gate and cue, those of them that there are; then diffuse, channel
// after channel. Without DIFFUSE the diffuse ones are read for their level.
//
// A pixel enters every SERIES × DIGITS clocks, and is at the output PHONGPIPE_DATAPATH_LATENCY - 3 clocks after
// these, and PHONGPIPE_DEPTH_CUE_LATENCY more with DEPTH_CUE.
`include "constants.svh"

module pixel_datapath_serial #(
    parameter int CHANNELS           = 1,   // 1 or 3
    parameter int DIFFUSE            = 1,
    parameter int SPECULAR           = 1,
    parameter int DEPTH_CUE          = 0,
    parameter int DIFFUSE_FRACTION   = 16,
    parameter int SPECULAR_FRACTION  = 12,
    parameter int ROM_ADDRESS_BITS   = 10,
    parameter int ROM_DATA_BITS      = 8,
    parameter int GATE               = `PHONGPIPE_GATE_DIFFUSE,
    parameter int SPECULAR_GUARD     = `PHONGPIPE_GUARD_BITS,
    parameter int ROM_LAYOUT         = `PHONGPIPE_LAYOUT_PLAIN,
    parameter int ROM_OCTAVES        = 4,
    localparam int X_BITS      = `PHONGPIPE_COORDINATE_BITS,
    localparam int LENGTH_BITS = `PHONGPIPE_LENGTH_BITS,
    localparam int COLOR_BITS  = `PHONGPIPE_OUTPUT_BITS,
    localparam int DIGIT_BITS  = `PHONGPIPE_DIGIT_BITS
) (
    input logic clk,
    input logic reset,  // synchronous; drops every pixel in flight, keeps the table

    input  logic                                span_valid,
    output logic                                span_ready,
    input  logic [                  X_BITS-1:0] span_x,
    input  logic [                  X_BITS-1:0] span_y,
    input  logic [             LENGTH_BITS-1:0] span_length,
    input  logic                                span_first_pass,
    input  logic                                span_step_diffuse,
    input  logic                                span_step_specular,
    input  logic                                span_highlight,
    output logic [  `PHONGPIPE_SERIES_BITS-1:0] span_series,
    output logic [`PHONGPIPE_DIGIT_PLACE_BITS-1:0] span_digit,
    input  logic [              DIGIT_BITS-1:0] span_v,
    input  logic [              DIGIT_BITS-1:0] span_d1,
    input  logic [              DIGIT_BITS-1:0] span_d2,
    input  logic [              DIGIT_BITS-1:0] span_level,
    input  logic [     CHANNELS*COLOR_BITS-1:0] cue_color,

    input logic                              rom_write,
    input logic [      ROM_ADDRESS_BITS-1:0] rom_address,
    input logic [CHANNELS*ROM_DATA_BITS-1:0] rom_data,

    output logic                           pixel_valid,
    input  logic                           pixel_ready,
    output logic [             X_BITS-1:0] pixel_x,
    output logic [             X_BITS-1:0] pixel_y,
    output logic [CHANNELS*COLOR_BITS-1:0] pixel_color
);
  `PHONGPIPE_CHECK_PARAMETERS

  localparam int DIFFUSE_WIDTH = 1 + `PHONGPIPE_GUARD_BITS + `PHONGPIPE_OUTPUT_BITS + DIFFUSE_FRACTION;
  localparam int SPECULAR_WIDTH = 1 + SPECULAR_GUARD + ROM_ADDRESS_BITS + SPECULAR_FRACTION;
  localparam int CUE_WIDTH = `PHONGPIPE_CUE_WIDTH;
  localparam int HAS_SPECULAR = SPECULAR != 0 ? 1 : 0;
  localparam int HAS_GATE = SPECULAR != 0 && GATE == `PHONGPIPE_GATE_SERIES ? 1 : 0;
  localparam int HAS_CUE = DEPTH_CUE != 0 ? 1 : 0;
  localparam int GATE_SERIES = HAS_SPECULAR;
  localparam int CUE_SERIES = GATE_SERIES + HAS_GATE;
  localparam int DIFFUSE_SERIES = CUE_SERIES + HAS_CUE;
  localparam int SERIES = DIFFUSE_SERIES + CHANNELS;
  localparam int LEAST_WIDTH = `PHONGPIPE_LEAST_DIGITS * DIGIT_BITS;
  localparam int AT_LEAST = DIFFUSE_WIDTH > LEAST_WIDTH ? DIFFUSE_WIDTH : LEAST_WIDTH;
  localparam int OR_SPECULAR = HAS_SPECULAR != 0 && SPECULAR_WIDTH > AT_LEAST ? SPECULAR_WIDTH : AT_LEAST;
  localparam int WIDEST = HAS_CUE != 0 && CUE_WIDTH > OR_SPECULAR ? CUE_WIDTH : OR_SPECULAR;
  localparam int DIGITS = (WIDEST + DIGIT_BITS - 1) / DIGIT_BITS;
  localparam int LAST = `PHONGPIPE_DATAPATH_LATENCY - 3 + (DEPTH_CUE != 0 ? `PHONGPIPE_DEPTH_CUE_LATENCY : 0);

  // Stages, by the number in a register's name or the index of its bit: 0 a pixel that entered in the clock
  // before; 3 its series, when all digits are there; the others are those of color_pipeline. In between, s1_
  // is stage 1 of serial_differencer.
  logic room, idle, load, enter, s0_valid;
  span_control control (
      .clk,
      .reset,
      .room(room && idle),
      .span_valid,
      .span_length,
      .span_ready,
      .load,
      .enter
  );

  logic [X_BITS-1:0] s0_x, s0_y;
  logic s0_highlight, s0_first_pass, s0_step_diffuse, s0_step_specular;
  logic [SERIES-1:0] stepping, s1_of_series;
  logic [DIGIT_BITS-1:0] s1_v;
  logic [LAST:3] valid;
  logic s1_last, s3_highlight, s3_first_pass;
  always_ff @(posedge clk) begin
    if (enter) s0_x <= load ? span_x : s0_x + 1'b1;
    if (load) begin
      s0_y <= span_y;
      s0_highlight <= span_highlight;
      s0_first_pass <= span_first_pass;
      s0_step_diffuse <= span_step_diffuse;
      s0_step_specular <= span_step_specular;
    end
    s3_highlight <= s0_highlight;
    s3_first_pass <= s0_first_pass;
    s0_valid <= enter && !reset;
    valid <= reset ? '0 : {valid[LAST-1:3], s1_last};
  end

  serial_differencer #(
      .SERIES(SERIES),
      .DIGITS(DIGITS)
  ) differencer (
      .clk,
      .reset,
      .idle,
      .start(enter),
      .first(load),
      .s1_stepping(stepping),
      .series(span_series),
      .digit(span_digit),
      .s1_start_v(span_v),
      .s1_start_d1(span_d1),
      .s1_start_d2(span_d2),
      .s1_of_series,
      .s1_v,
      .s1_last
  );

  logic [CHANNELS*DIFFUSE_WIDTH-1:0] s3_level, s4_level, s3_diffuse, s4_diffuse;
  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    assign stepping[DIFFUSE_SERIES+c] = s0_step_diffuse;
    digit_register #(
        .WIDTH (DIFFUSE_WIDTH),
        .DIGITS(DIGITS)
    ) level (
        .clk,
        .take(s1_of_series[DIFFUSE_SERIES+c]),
        .s1_digit(span_level),
        .s3_v(s3_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .s4_v(s4_level[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH])
    );
    if (DIFFUSE != 0) begin : diffuse
      digit_register #(
          .WIDTH (DIFFUSE_WIDTH),
          .DIGITS(DIGITS)
      ) diffuse_series (
          .clk,
          .take(s1_of_series[DIFFUSE_SERIES+c]),
          .s1_digit(s1_v),
          .s3_v(s3_diffuse[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
          .s4_v(s4_diffuse[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH])
      );
    end
  end
  if (DIFFUSE == 0) begin : unlit
    assign {s3_diffuse, s4_diffuse} = '0;
    wire unused = &{1'b0, s1_v};
  end

  logic [SPECULAR_WIDTH-1:0] s3_specular, s4_specular;
  if (HAS_SPECULAR != 0) begin : specular
    assign stepping[0] = s0_step_specular;
    digit_register #(
        .WIDTH (SPECULAR_WIDTH),
        .DIGITS(DIGITS)
    ) specular_series (
        .clk,
        .take(s1_of_series[0]),
        .s1_digit(s1_v),
        .s3_v(s3_specular),
        .s4_v(s4_specular)
    );
  end else begin : no_specular
    assign {s3_specular, s4_specular} = '0;
    wire unused = &{1'b0, s0_step_specular};
  end

  logic [DIFFUSE_WIDTH-1:0] s3_gate, s4_gate;
  if (HAS_GATE != 0) begin : gate
    assign stepping[GATE_SERIES] = s0_step_diffuse;
    digit_register #(
        .WIDTH (DIFFUSE_WIDTH),
        .DIGITS(DIGITS)
    ) gate_series (
        .clk,
        .take(s1_of_series[GATE_SERIES]),
        .s1_digit(s1_v),
        .s3_v(s3_gate),
        .s4_v(s4_gate)
    );
  end else begin : no_gate_series
    assign {s3_gate, s4_gate} = '0;
  end

  logic [CUE_WIDTH-1:0] s3_cue, s4_cue;
  if (HAS_CUE != 0) begin : cueing
    assign stepping[CUE_SERIES] = 1'b1;
    digit_register #(
        .WIDTH (CUE_WIDTH),
        .DIGITS(DIGITS)
    ) cue_series (
        .clk,
        .take(s1_of_series[CUE_SERIES]),
        .s1_digit(s1_v),
        .s3_v(s3_cue),
        .s4_v(s4_cue)
    );
  end else begin : no_cueing
    assign {s3_cue, s4_cue} = '0;
  end
  wire unused_words = &{1'b0, s4_level, s3_diffuse, s3_specular, s3_gate, s3_cue};

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
      .s3_highlight,
      .s3_first_pass,
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
      .entered(s0_valid),
      .place_valid(s0_valid),
      .place({s0_x, s0_y}),
      .color_valid(valid[LAST]),
      .color(last_color),
      .pixel_valid,
      .pixel_ready,
      .pixel_place({pixel_x, pixel_y}),
      .pixel_color
  );
endmodule
