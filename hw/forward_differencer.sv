// v' = v + d1, d1' = d1 + d2. Two additions a step, no rounding; all registers wrap.
// `load` takes a new start and wins over `step`. v is valid in the clock after either.
module forward_differencer #(
    parameter int WIDTH = 26
) (
    input  logic             clk,
    input  logic             load,
    input  logic             step,
    input  logic [WIDTH-1:0] start_v,
    input  logic [WIDTH-1:0] start_d1,
    input  logic [WIDTH-1:0] start_d2,
    output logic [WIDTH-1:0] v
);
  logic [WIDTH-1:0] d1;
  logic [WIDTH-1:0] d2;

  always_ff @(posedge clk) begin
    if (load) begin
      v  <= start_v;
      d1 <= start_d1;
      d2 <= start_d2;
    end else if (step) begin
      v  <= v + d1;
      d1 <= d1 + d2;
    end
  end
endmodule
