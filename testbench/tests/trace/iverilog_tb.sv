// Drives pixel_datapath with two spans and records it, for a test of waveforms from other tools.
module iverilog_tb;
  logic clk = 0, reset = 1, span_valid = 0, rom_write = 0;
  logic [9:0] rom_address = 0;
  logic [7:0] rom_data = 0;
  logic [11:0] span_x = 10;
  wire span_ready, pixel_valid;
  wire [11:0] pixel_x, pixel_y;
  wire [7:0] pixel_color;

  pixel_datapath pixel_datapath (
      .clk, .reset, .span_valid, .span_ready, .span_x, .span_y(12'd7), .span_length(13'd6),
      .span_first_pass(1'b1), .span_step_diffuse(1'b1), .span_step_specular(1'b1),
      .span_highlight(1'b1), .span_diffuse_v(26'h0640000), .span_diffuse_d1(26'h0004000),
      .span_diffuse_d2(26'h0000100), .span_level(26'h00a8000), .span_specular_v(24'h300000),
      .span_specular_d1(24'h001800), .span_specular_d2(24'hfffff0), .span_gate_v(26'd0),
      .span_gate_d1(26'd0), .span_gate_d2(26'd0), .span_cue_v(32'd0), .span_cue_d1(32'd0),
      .cue_color(8'd0), .rom_write, .rom_address, .rom_data, .pixel_valid, .pixel_ready(1'b1),
      .pixel_x, .pixel_y, .pixel_color
  );

  always #5 clk = !clk;
  initial begin
    @(negedge clk) reset = 0;
    rom_write = 1;
    repeat (1024) @(negedge clk) begin
      rom_address = rom_address + 1;
      rom_data = rom_address[9:2];
    end
    rom_write = 0;
    $dumpfile("iverilog.vcd");
    $dumpvars;
    span_valid = 1;
    @(negedge clk);
    span_x = 100;  // is taken with the last pixel of the first
    repeat (6) @(negedge clk);
    span_valid = 0;
    repeat (24) @(negedge clk);
    $finish;
  end
endmodule
