// The queue behind a pipeline that never stalls. `room`: one more pixel may enter, for there will be a slot
// for it. A pixel is counted a clock after it entered, so that one more than there are slots may be inside:
// it finds its slot free because another one stands at the output by then. Proved in pixel_queue_proof.sv.
//
// The place of a pixel is written before its colour. A pixel is at the output 2 clocks after its colour was
// written, or later; its slot is free 2 clocks after it left.
`include "constants.svh"

module pixel_queue #(
    parameter int PLACE_BITS = 24,
    parameter int COLOR_BITS = 8
) (
    input  logic                  clk,
    input  logic                  reset,
    output logic                  room,
    input  logic                  entered,      // a pixel, in the clock before; not without room
    input  logic                  place_valid,
    input  logic [PLACE_BITS-1:0] place,
    input  logic                  color_valid,
    input  logic [COLOR_BITS-1:0] color,
    output logic                  pixel_valid,
    input  logic                  pixel_ready,
    output logic [PLACE_BITS-1:0] pixel_place,
    output logic [COLOR_BITS-1:0] pixel_color
);
  localparam int SLOT_BITS = `PHONGPIPE_PIXEL_QUEUE_BITS;

  // No slot is read in the clock in which it is written.
  (* no_rw_check *) logic [PLACE_BITS-1:0] places[1 << SLOT_BITS];
  (* no_rw_check *) logic [COLOR_BITS-1:0] colors[1 << SLOT_BITS];
  logic [SLOT_BITS-1:0] place_slot, color_slot, read_slot;
  logic left;  // a pixel, in the clock before

  // Negative while there are free slots, and while there are colours to read. Their signs are flags that
  // need no comparison.
  logic [SLOT_BITS:0] minus_free, minus_colors;
  assign room = minus_free[SLOT_BITS];
  wire read = minus_colors[SLOT_BITS] && (!pixel_valid || pixel_ready);
  wire [SLOT_BITS+1:0] minus_free_next = {minus_free, 1'b1} + {{(SLOT_BITS + 1) {left}}, entered};
  wire [SLOT_BITS+1:0] minus_colors_next = {minus_colors, 1'b1} + {{(SLOT_BITS + 1) {color_valid}}, read};
  wire unused = &{1'b0, minus_free_next[0], minus_colors_next[0]};

  always_ff @(posedge clk) begin
    if (place_valid) places[place_slot] <= place;
    if (color_valid) colors[color_slot] <= color;
    if (read) begin
      pixel_place <= places[read_slot];
      pixel_color <= colors[read_slot];
    end
    if (reset) begin
      {place_slot, color_slot, read_slot} <= '0;
      minus_free <= {1'b1, {SLOT_BITS{1'b0}}};
      minus_colors <= '0;
      pixel_valid <= 1'b0;
      left <= 1'b0;
    end else begin
      place_slot <= place_slot + SLOT_BITS'(place_valid);
      color_slot <= color_slot + SLOT_BITS'(color_valid);
      read_slot <= read_slot + SLOT_BITS'(read);
      minus_free <= minus_free_next[SLOT_BITS+1:1];
      minus_colors <= minus_colors_next[SLOT_BITS+1:1];
      pixel_valid <= read || (pixel_valid && !pixel_ready);
      left <= pixel_valid && pixel_ready;
    end
  end
endmodule
