// pixel_queue behind a pipeline of STAGES that never stalls, with whatever enters and is taken. The assertions
// are an invariant: what holds in a state in which they hold, holds in the next; see
// pixel_queue_proof_test.cpp.
`include "constants.svh"

module pixel_queue_proof #(
    parameter int STAGES = 11
) (
    input logic clk,
    input logic reset,
    input logic wish,  // a pixel would enter
    input logic pixel_ready
);
  localparam int SLOTS = 1 << `PHONGPIPE_PIXEL_QUEUE_BITS;
  localparam int BITS = `PHONGPIPE_PIXEL_QUEUE_BITS + 2;

  wire room, pixel_valid, place, color;
  // The registers of pixel_queue of the same names: the script of the proof connects them.
  wire [`PHONGPIPE_PIXEL_QUEUE_BITS:0] minus_free, minus_colors;
  wire [`PHONGPIPE_PIXEL_QUEUE_BITS-1:0] place_slot, color_slot, read_slot;
  wire left;
  logic [STAGES-1:0] valid;
  pixel_queue #(
      .PLACE_BITS(1),
      .COLOR_BITS(1)
  ) queue (
      .clk, .reset, .room, .entered(valid[0]), .place_valid(valid[1]), .place(1'b0),
      .color_valid(valid[STAGES-1]), .color(1'b0), .pixel_valid, .pixel_ready, .pixel_place(place),
      .pixel_color(color)
  );
  // Clocks for which the output was taken whenever it was valid, and nothing could enter.
  logic [2:0] waiting;
  always_ff @(posedge clk) begin
    if (reset) begin
      valid <= '0;
      waiting <= '0;
    end else begin
      valid <= {valid[STAGES-2:0], wish && room};
      waiting <= room || !pixel_ready ? 3'd0 : waiting + 3'd1;
    end
  end

  logic [BITS-1:0] in_pipeline, placed;  // placed: whose place was written
  always_comb begin
    in_pipeline = '0;
    for (int i = 0; i < STAGES; i++) in_pipeline = in_pipeline + BITS'(valid[i]);
    placed = in_pipeline - BITS'(valid[0]) - BITS'(valid[1]);
  end
  wire [BITS-1:0] colors = -{minus_colors[BITS-2], minus_colors};
  wire [BITS-1:0] used = BITS'(SLOTS) + {minus_free[BITS-2], minus_free};
  wire [BITS-1:0] inside_all = in_pipeline + colors + BITS'(pixel_valid);

  always_comb begin
    // Pixels are counted a clock after they entered, and until the clock after they left.
    assert (used == inside_all - BITS'(valid[0]) + BITS'(left));
    assert (inside_all <= BITS'(SLOTS + 1));
    // No colour and no place is overwritten before it was read.
    assert (colors <= BITS'(SLOTS));
    assert (colors + placed <= BITS'(SLOTS));
    assert (color_slot - read_slot == colors[BITS-3:0]);
    assert (place_slot - color_slot == placed[BITS-3:0]);
    // A full queue cannot deadlock: while it is taken from, there is room again within 4 clocks.
    assert (waiting <= 3'd4);
  end
endmodule
