// Two pixel_datapath: one of its own width, and one WIDER bits wider with twice the table, whose inputs are
// shifted left. For a proof that they stay equal, see superset_proof_test.cpp.
module superset_aligned #(
    parameter int DIFFUSE_FRACTION  = 8,
    parameter int SPECULAR_FRACTION = 6,
    parameter int WIDER             = 4,
    localparam int DIFFUSE_WIDTH  = 10 + DIFFUSE_FRACTION,
    localparam int SPECULAR_WIDTH = 8 + SPECULAR_FRACTION
) (
    input  logic                      clk,
    input  logic                      reset,
    input  logic                      rom_write,
    input  logic                      span_valid,
    input  logic [              11:0] span_x,
    input  logic [              11:0] span_y,
    input  logic [              12:0] span_length,
    input  logic                      span_step_diffuse,
    input  logic                      span_step_specular,
    input  logic                      span_highlight,
    input  logic [ DIFFUSE_WIDTH-1:0] diffuse_v,
    input  logic [ DIFFUSE_WIDTH-1:0] diffuse_d1,
    input  logic [ DIFFUSE_WIDTH-1:0] diffuse_d2,
    input  logic [ DIFFUSE_WIDTH-1:0] level,
    input  logic [SPECULAR_WIDTH-1:0] specular_v,
    input  logic [SPECULAR_WIDTH-1:0] specular_d1,
    input  logic [SPECULAR_WIDTH-1:0] specular_d2,
    input  logic                      pixel_ready
);
  localparam logic [WIDER-1:0] ZEROS = '0;

  pixel_datapath #(
      .DIFFUSE_FRACTION (DIFFUSE_FRACTION),
      .SPECULAR_FRACTION(SPECULAR_FRACTION),
      .ROM_ADDRESS_BITS (6)
  ) narrow (
      .clk, .reset, .span_valid, .span_ready(), .span_x, .span_y, .span_length, .span_step_diffuse,
      .span_step_specular, .span_highlight, .span_first_pass(1'b1),
      .span_diffuse_v(diffuse_v), .span_diffuse_d1(diffuse_d1), .span_diffuse_d2(diffuse_d2),
      .span_level(level), .span_specular_v(specular_v), .span_specular_d1(specular_d1),
      .span_specular_d2(specular_d2), .span_gate_v('0), .span_gate_d1('0), .span_gate_d2('0),
      .span_cue_v('0), .span_cue_d1('0), .cue_color('0), .rom_write, .rom_address('0), .rom_data('0),
      .pixel_ready, .pixel_valid(), .pixel_x(), .pixel_y(), .pixel_color()
  );
  pixel_datapath #(
      .DIFFUSE_FRACTION (DIFFUSE_FRACTION + WIDER),
      .SPECULAR_FRACTION(SPECULAR_FRACTION + WIDER - 1),
      .ROM_ADDRESS_BITS (7)
  ) wide (
      .clk, .reset, .span_valid, .span_ready(), .span_x, .span_y, .span_length, .span_step_diffuse,
      .span_step_specular, .span_highlight, .span_first_pass(1'b1),
      .span_diffuse_v({diffuse_v, ZEROS}), .span_diffuse_d1({diffuse_d1, ZEROS}),
      .span_diffuse_d2({diffuse_d2, ZEROS}), .span_level({level, ZEROS}),
      .span_specular_v({specular_v, ZEROS}), .span_specular_d1({specular_d1, ZEROS}),
      .span_specular_d2({specular_d2, ZEROS}), .span_gate_v('0), .span_gate_d1('0), .span_gate_d2('0),
      .span_cue_v('0), .span_cue_d1('0), .cue_color('0), .rom_write, .rom_address('0), .rom_data('0),
      .pixel_ready, .pixel_valid(), .pixel_x(), .pixel_y(), .pixel_color()
  );
endmodule
