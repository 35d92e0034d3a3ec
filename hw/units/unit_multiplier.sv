// product = a * b, in two's complement. One product a clock, B_BITS clocks from the operands: a row of partial
// products is added up in each, the lowest bit of b first; that of the sign is subtracted.
module unit_multiplier #(
    parameter int A_BITS = 16,  // at least 2
    parameter int B_BITS = 16   // at least 2
) (
    input  logic                     clk,
    input  logic [       A_BITS-1:0] a,
    input  logic [       B_BITS-1:0] b,
    output logic [A_BITS+B_BITS-1:0] product
);
  // Stage k has added rows 0 to k. A row's sum needs A_BITS + 1 bits above the bits that are final, which move
  // into `s_low` with each row.
  for (genvar k = 0; k < B_BITS; k++) begin : row
    logic [A_BITS-1:0] s_a;
    logic [B_BITS-1:0] s_b;
    logic [A_BITS-1:0] s_high;   // of the sum, above bit k
    logic [k:0] s_low;           // its final bits
    wire [A_BITS-1:0] row_a, row_high;
    wire [B_BITS-1:0] row_b;
    if (k == 0) begin : first
      assign row_a = a;
      assign row_b = b;
      assign row_high = '0;
    end else begin : next
      assign row_a = row[k-1].s_a;
      assign row_b = row[k-1].s_b;
      assign row_high = row[k-1].s_high;
    end
    localparam bit NEGATIVE = k == B_BITS - 1;
    // Negated as complement plus one: the one is the carry of a bit below.
    wire [A_BITS-1:0] gated = row_a & {A_BITS{row_b[k]}};
    wire [A_BITS-1:0] addend = NEGATIVE ? ~gated : gated;
    wire [A_BITS+1:0] sum = {row_high[A_BITS-1], row_high, NEGATIVE} + {addend[A_BITS-1], addend, NEGATIVE};
    wire unused = &{1'b0, sum[0]};
    always_ff @(posedge clk) begin
      s_a <= row_a;
      s_b <= row_b;
      s_high <= sum[A_BITS+1:2];
    end
    if (k == 0) begin : low_first
      always_ff @(posedge clk) s_low <= sum[1];
    end else begin : low_next
      always_ff @(posedge clk) s_low <= {sum[1], row[k-1].s_low};
    end
  end
  wire unused_operands = &{1'b0, row[B_BITS-1].s_a, row[B_BITS-1].s_b};
  assign product = {row[B_BITS-1].s_high, row[B_BITS-1].s_low};
endmodule
