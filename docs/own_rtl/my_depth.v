// DEPTH of another hand: a queue of any length, and a fragment waits while one of its pixel is in flight.
module my_depth #(
  parameter QUEUE = 8 // fragments that may be in flight, 2 to 16
) (
  input  wire        clk,
  input  wire        reset,
  input  wire [2:0]  func,    // new ? old: 0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always
  input  wire        z_write,
  // fragments
  input  wire        f_valid,
  output wire        f_ready,
  input  wire [18:0] f_addr,
  input  wire [31:0] f_z,     // 24 bits count
  input  wire [23:0] f_rgb,
  // old depths
  output wire        rd_valid,
  input  wire        rd_ready,
  output wire [18:0] rd_addr,
  input  wire        data_valid,
  output wire        data_ready,
  input  wire [23:0] data_z,
  // pixels that pass
  output reg         w_valid,
  input  wire        w_ready,
  output reg  [18:0] w_addr,
  output reg  [31:0] w_z,
  output reg         w_z_en,
  output reg  [23:0] w_rgb
);
  reg [18:0] addr [0:15];
  reg [23:0] z    [0:15];
  reg [23:0] rgb  [0:15];
  reg [3:0]  first, free;
  reg [4:0]  count;

  // A fragment of a pixel in flight, in the queue or on its way to the memory, waits.
  integer i;
  reg same;
  always @* begin
    same = w_valid && w_addr == f_addr;
    for (i = 0; i < 16; i = i + 1)
      if (i < count && addr[(first + i) & 15] == f_addr) same = 1'b1;
  end
  wire may = count < QUEUE && !same;
  assign rd_valid = f_valid && may;
  assign rd_addr  = f_addr;
  assign f_ready  = rd_ready && may;
  wire enters = rd_valid && rd_ready;

  wire free_w = !w_valid || w_ready;
  assign data_ready = count != 0 && free_w;
  wire leaves = data_valid && data_ready;
  wire [23:0] new_z = z[first];
  wire less = new_z < data_z, equal = new_z == data_z;
  wire pass = less ? func[0] : equal ? func[1] : func[2];

  always @(posedge clk)
    if (reset) begin
      count <= 0;
      first <= 0;
      free <= 0;
      w_valid <= 1'b0;
    end else begin
      count <= count + enters - leaves;
      if (enters) begin
        addr[free] <= f_addr;
        z[free] <= f_z[23:0];
        rgb[free] <= f_rgb;
        free <= free + 1;
      end
      if (w_ready) w_valid <= 1'b0;
      if (leaves) begin
        first <= first + 1;
        w_valid <= pass;
        w_addr <= addr[first];
        w_z <= {8'b0, new_z};
        w_z_en <= z_write;
        w_rgb <= rgb[first];
      end
    end
endmodule
