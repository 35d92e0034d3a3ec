// Which pixel enters a datapath: the first one of the span at the port, or the next one of the span that was
// taken last.
//
// A pixel enters where `room` is high, unless the last span is over and none is offered. Then `remaining`, in
// the next clock, are the pixels of its span that have not entered, itself among them; `ending`: they are 2;
// `open`: the next pixel is of another span. What the control decides is registered before it is used.
`include "constants.svh"

module span_control (
    input  logic                              clk,
    input  logic                              reset,
    input  logic                              room,         // for one more pixel
    input  logic                              span_valid,
    input  logic [`PHONGPIPE_LENGTH_BITS-1:0] span_length,  // at least 1
    output logic                              span_ready,
    output logic                              load,         // a span is taken, and its first pixel enters
    output logic                              enter         // a pixel enters
);
  logic [`PHONGPIPE_LENGTH_BITS-1:0] remaining;
  logic open, ending;
  assign span_ready = room && open;
  assign load = span_ready && span_valid;
  assign enter = load || (room && !open);

  always_ff @(posedge clk) begin
    if (room) begin
      remaining <= open ? span_length : remaining - 1'b1;
      ending <= open ? span_length == 2 : remaining == 3;
    end
    if (reset) open <= 1'b1;
    else open <= open ? !load || span_length == 1 : room && ending;
  end
endmodule
