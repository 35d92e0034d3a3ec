// LANES pixels a clock: as many pixel_datapaths that take turns along a span, behind one block that computes
// where each of them starts, and by how much it steps.
//
// Parameters and ports are those of pixel_datapath.sv, but for the output. A group of up to LANES pixels, side by
// side from pixel_x on, is delivered where pixel_valid[0] and pixel_ready are high. The first pixel is in the low
// bits of pixel_color. Bit k of pixel_valid tells whether the span has pixel k of the group.
// span_ready is low while a span waits for the lanes. The first group is at the output 3 clocks later than the
// first pixel of pixel_datapath.
`include "constants.svh"

module pixel_datapath_wide #(
    parameter int LANES              = 2,   // 2 or 4
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
    localparam int DIFFUSE_WIDTH  = 1 + `PHONGPIPE_GUARD_BITS
                                  + `PHONGPIPE_OUTPUT_BITS + DIFFUSE_FRACTION,
    localparam int SPECULAR_WIDTH = 1 + SPECULAR_GUARD + ROM_ADDRESS_BITS + SPECULAR_FRACTION,
    localparam int X_BITS         = `PHONGPIPE_COORDINATE_BITS,
    localparam int LENGTH_BITS    = `PHONGPIPE_LENGTH_BITS,
    localparam int COLOR_BITS     = `PHONGPIPE_OUTPUT_BITS,
    localparam int CUE_WIDTH      = `PHONGPIPE_CUE_WIDTH
) (
    input logic clk,
    input logic reset,

    input  logic                              span_valid,
    output logic                              span_ready,
    input  logic [                X_BITS-1:0] span_x,
    input  logic [                X_BITS-1:0] span_y,
    input  logic [           LENGTH_BITS-1:0] span_length,
    input  logic                              span_first_pass,
    input  logic                              span_step_diffuse,
    input  logic                              span_step_specular,
    input  logic                              span_highlight,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_diffuse_v,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_diffuse_d1,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_diffuse_d2,
    input  logic [CHANNELS*DIFFUSE_WIDTH-1:0] span_level,
    input  logic [        SPECULAR_WIDTH-1:0] span_specular_v,
    input  logic [        SPECULAR_WIDTH-1:0] span_specular_d1,
    input  logic [        SPECULAR_WIDTH-1:0] span_specular_d2,
    input  logic [         DIFFUSE_WIDTH-1:0] span_gate_v,
    input  logic [         DIFFUSE_WIDTH-1:0] span_gate_d1,
    input  logic [         DIFFUSE_WIDTH-1:0] span_gate_d2,
    input  logic [             CUE_WIDTH-1:0] span_cue_v,
    input  logic [             CUE_WIDTH-1:0] span_cue_d1,
    input  logic [   CHANNELS*COLOR_BITS-1:0] cue_color,

    input logic                              rom_write,
    input logic [      ROM_ADDRESS_BITS-1:0] rom_address,
    input logic [CHANNELS*ROM_DATA_BITS-1:0] rom_data,

    output logic [                    LANES-1:0] pixel_valid,
    input  logic                                 pixel_ready,
    output logic [                   X_BITS-1:0] pixel_x,
    output logic [                   X_BITS-1:0] pixel_y,
    output logic [LANES*CHANNELS*COLOR_BITS-1:0] pixel_color
);
  `PHONGPIPE_CHECK_PARAMETERS
  if (LANES != 2 && LANES != 4) begin : LANES_out_of_range
    LANES_must_be_2_or_4 stop ();
  end
  localparam int LANE_BITS = LANES == 2 ? 1 : 2;
  localparam int REST_BITS = X_BITS + 1;

  // Three stages before the lanes. All wait while the lanes do not take what is in the last one.
  logic lanes_ready;
  logic [3:1] held;  // a span
  wire advance = !held[3] || lanes_ready;
  assign span_ready = advance;

  // What the lanes take as it is.
  localparam int KEPT = X_BITS + 4 + CHANNELS * DIFFUSE_WIDTH;
  logic [KEPT-1:0] l1_kept, l2_kept, l3_kept;
  logic [X_BITS-1:0] l1_x, l2_x, l3_x, l2_rest, l3_y;
  logic [LENGTH_BITS-1:0] l1_length, l3_groups;
  logic l3_first_pass, l3_step_diffuse, l3_step_specular, l3_highlight;
  logic [CHANNELS*DIFFUSE_WIDTH-1:0] l3_level;
  assign {l3_y, l3_first_pass, l3_step_diffuse, l3_step_specular, l3_highlight, l3_level} = l3_kept;
  wire unused_length = &{1'b0, l1_length[LENGTH_BITS-1]};

  always_ff @(posedge clk) begin
    if (advance) begin
      l1_kept <= {span_y, span_first_pass, span_step_diffuse, span_step_specular, span_highlight, span_level};
      l1_x <= span_x;
      l1_length <= span_length;
      l2_kept <= l1_kept;
      l2_x <= l1_x;
      l2_rest <= l1_length[X_BITS-1:0] - 1'b1;  // pixels after the first
      l3_kept <= l2_kept;
      l3_x <= l2_x;
      l3_groups <= LENGTH_BITS'(l2_rest[X_BITS-1:LANE_BITS]) + 1'b1;
    end
    if (reset) held <= '0;
    else if (advance) held <= {held[2:1], span_valid};
  end

  // Series after series, each with its lanes.
  logic [CHANNELS*LANES*DIFFUSE_WIDTH-1:0] diffuse_v, diffuse_d1;
  logic [CHANNELS*DIFFUSE_WIDTH-1:0] diffuse_d2;
  for (genvar c = 0; c < CHANNELS; c++) begin : channel
    series_lanes #(
        .WIDTH(DIFFUSE_WIDTH),
        .LANES(LANES)
    ) diffuse_lanes (
        .clk,
        .advance,
        .stepping(span_step_diffuse),
        .v(span_diffuse_v[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .d1(span_diffuse_d1[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .d2(span_diffuse_d2[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .lane_v(diffuse_v[c*LANES*DIFFUSE_WIDTH+:LANES*DIFFUSE_WIDTH]),
        .lane_d1(diffuse_d1[c*LANES*DIFFUSE_WIDTH+:LANES*DIFFUSE_WIDTH]),
        .lane_d2(diffuse_d2[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH])
    );
  end
  logic [LANES*SPECULAR_WIDTH-1:0] specular_v, specular_d1;
  logic [SPECULAR_WIDTH-1:0] specular_d2;
  series_lanes #(
      .WIDTH(SPECULAR_WIDTH),
      .LANES(LANES)
  ) specular_lanes (
      .clk,
      .advance,
      .stepping(span_step_specular),
      .v(span_specular_v),
      .d1(span_specular_d1),
      .d2(span_specular_d2),
      .lane_v(specular_v),
      .lane_d1(specular_d1),
      .lane_d2(specular_d2)
  );
  logic [LANES*DIFFUSE_WIDTH-1:0] gate_v, gate_d1;
  logic [DIFFUSE_WIDTH-1:0] gate_d2;
  series_lanes #(
      .WIDTH(DIFFUSE_WIDTH),
      .LANES(LANES)
  ) gate_lanes (
      .clk,
      .advance,
      .stepping(span_step_diffuse),
      .v(span_gate_v),
      .d1(span_gate_d1),
      .d2(span_gate_d2),
      .lane_v(gate_v),
      .lane_d1(gate_d1),
      .lane_d2(gate_d2)
  );
  logic [LANES*CUE_WIDTH-1:0] cue_v, cue_d1;
  logic [CUE_WIDTH-1:0] cue_d2;
  wire unused_cue = &{1'b0, cue_d2};
  series_lanes #(
      .WIDTH(CUE_WIDTH),
      .LANES(LANES)
  ) cue_lanes (
      .clk,
      .advance,
      .stepping(1'b1),
      .v(span_cue_v),
      .d1(span_cue_d1),
      .d2({CUE_WIDTH{1'b0}}),
      .lane_v(cue_v),
      .lane_d1(cue_d1),
      .lane_d2(cue_d2)
  );

  // All lanes are in step, for each takes as many pixels as there are groups. Of the last group the span may
  // have some only: lanes 1 and up have in place of x minus the number of their pixels in the span that are
  // still to come, which is negative while there are any. Lane 0 has the place of the group.
  logic [LANES-1:0] ready, valid;
  logic [LANES*X_BITS-1:0] lane_x, lane_y;
  assign lanes_ready = ready[0];
  for (genvar k = 0; k < LANES; k++) begin : lane
    localparam int X_STEP = k == 0 ? LANES : 1;
    logic [X_BITS-1:0] x, y;
    if (k == 0) begin : first
      assign {x, y} = {l3_x, l3_y};
      assign pixel_valid[k] = valid[0];
    end else begin : further
      assign y = '0;
      // One less than there are pixels of this lane; negative if there is none.
      wire signed [REST_BITS-1:0] rest = $signed({1'b0, l2_rest} - REST_BITS'(k)) >>> LANE_BITS;
      wire unused_rest = &{1'b0, rest[REST_BITS-1]};
      always_ff @(posedge clk) if (advance) x <= ~rest[X_BITS-1:0];
      assign pixel_valid[k] = valid[0] && lane_x[(k+1)*X_BITS-1];
    end
    logic [CHANNELS*DIFFUSE_WIDTH-1:0] own_v, own_d1;
    for (genvar c = 0; c < CHANNELS; c++) begin : channel
      assign own_v[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH] = diffuse_v[(c*LANES+k)*DIFFUSE_WIDTH+:DIFFUSE_WIDTH];
      assign own_d1[c*DIFFUSE_WIDTH+:DIFFUSE_WIDTH] = diffuse_d1[(c*LANES+k)*DIFFUSE_WIDTH+:DIFFUSE_WIDTH];
    end
    pixel_datapath #(
        .CHANNELS(CHANNELS),
        .DIFFUSE(DIFFUSE),
        .SPECULAR(SPECULAR),
        .DEPTH_CUE(DEPTH_CUE),
        .DIFFUSE_FRACTION(DIFFUSE_FRACTION),
        .SPECULAR_FRACTION(SPECULAR_FRACTION),
        .ROM_ADDRESS_BITS(ROM_ADDRESS_BITS),
        .ROM_DATA_BITS(ROM_DATA_BITS),
        .GATE(GATE),
        .SPECULAR_GUARD(SPECULAR_GUARD),
        .ROM_LAYOUT(ROM_LAYOUT),
        .ROM_OCTAVES(ROM_OCTAVES),
        .X_STEP(X_STEP)
    ) datapath (
        .clk,
        .reset,
        .span_valid(held[3]),
        .span_ready(ready[k]),
        .span_x(x),
        .span_y(y),
        .span_length(l3_groups),
        .span_first_pass(l3_first_pass),
        .span_step_diffuse(l3_step_diffuse),
        .span_step_specular(l3_step_specular),
        .span_highlight(l3_highlight),
        .span_diffuse_v(own_v),
        .span_diffuse_d1(own_d1),
        .span_diffuse_d2(diffuse_d2),
        .span_level(l3_level),
        .span_specular_v(specular_v[k*SPECULAR_WIDTH+:SPECULAR_WIDTH]),
        .span_specular_d1(specular_d1[k*SPECULAR_WIDTH+:SPECULAR_WIDTH]),
        .span_specular_d2(specular_d2),
        .span_gate_v(gate_v[k*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .span_gate_d1(gate_d1[k*DIFFUSE_WIDTH+:DIFFUSE_WIDTH]),
        .span_gate_d2(gate_d2),
        .span_cue_v(cue_v[k*CUE_WIDTH+:CUE_WIDTH]),
        .span_cue_d1(cue_d1[k*CUE_WIDTH+:CUE_WIDTH]),
        .cue_color,
        .rom_write,
        .rom_address,
        .rom_data,
        .pixel_valid(valid[k]),
        .pixel_ready,
        .pixel_x(lane_x[k*X_BITS+:X_BITS]),
        .pixel_y(lane_y[k*X_BITS+:X_BITS]),
        .pixel_color(pixel_color[k*CHANNELS*COLOR_BITS+:CHANNELS*COLOR_BITS])
    );
  end
  assign {pixel_x, pixel_y} = {lane_x[X_BITS-1:0], lane_y[X_BITS-1:0]};
  wire unused_lanes = &{1'b0, ready, valid, lane_x, lane_y};
endmodule
