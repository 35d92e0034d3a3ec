// What a span keeps for all its pixels: `start` of the clock in which the span was taken, 2 clocks later.
//
// A multiplexer in the form that yosys does not turn into a clock enable: devices have few nets for these.
module span_register #(
    parameter int WIDTH = 1
) (
    input  logic             clk,
    input  logic             load,   // a span was taken in the clock before
    input  logic [WIDTH-1:0] start,
    output logic [WIDTH-1:0] value
);
  logic [WIDTH-1:0] s0_start;

  always_ff @(posedge clk) begin
    s0_start <= start;
    value <= (s0_start & {WIDTH{load}}) | (value & {WIDTH{!load}});
  end
endmodule
