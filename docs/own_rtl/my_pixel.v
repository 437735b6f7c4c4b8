// PIXEL of another hand: own names, an active-low asynchronous reset, fields of a fragment in one port, one register stage
// more than ours, no status ports. It is an example of what `dut.toml` beside it describes.
module my_pixel #(
  parameter ZW = 38, // bits of a depth, the fraction below
  parameter CW = 22  // bits of a colour, likewise
) (
  input  wire          aclk,
  input  wire          aresetn,
  // spans
  input  wire          s_valid,
  output wire          s_ready,
  input  wire [14:0]   s_column,
  input  wire [8:0]    s_line,
  input  wire [14:0]   s_pixels,
  input  wire          s_left,
  input  wire [ZW-1:0] s_z,
  input  wire [CW-1:0] s_r, s_g, s_b,
  input  wire          s_first,
  input  wire          s_fence,
  input  wire [ZW-1:0] step_z,
  input  wire [CW-1:0] step_r, step_g, step_b,
  // fragments: {fence, b, g, r, z, address}
  output reg           m_valid,
  input  wire          m_ready,
  output reg  [67:0]   m_data
);
  reg          busy, left, fence;
  reg [14:0]   column, pixels;
  reg [8:0]    line;
  reg [ZW-1:0] z, dz;
  reg [CW-1:0] r, g, b, dr, dg, db;

  // Two stages: the walk gives a fragment to `stage`, `stage` to the output.
  reg          stage_valid;
  reg [67:0]   stage;
  wire         stage_ready = !stage_valid || !m_valid || m_ready;
  wire         on_screen   = !column[14] && column < 640;
  wire         step        = busy && (stage_ready || !on_screen);

  assign s_ready = !busy || (step && pixels == 1);

  always @(posedge aclk or negedge aresetn)
    if (!aresetn) begin
      busy <= 1'b0;
      stage_valid <= 1'b0;
      m_valid <= 1'b0;
    end else begin
      if (!m_valid || m_ready) begin
        m_valid <= stage_valid;
        m_data  <= stage;
        stage_valid <= 1'b0;
      end
      if (step) begin
        if (on_screen) begin
          stage_valid <= 1'b1;
          stage <= {fence, b[CW-1-:8], g[CW-1-:8], r[CW-1-:8], z[ZW-1-:24], line, column[9:0]};
          fence <= 1'b0;
        end
        column <= left ? column - 1 : column + 1;
        z <= z + dz;
        r <= r + dr;
        g <= g + dg;
        b <= b + db;
        pixels <= pixels - 1;
        if (pixels == 1) busy <= 1'b0;
      end
      if (s_valid && s_ready) begin
        busy <= 1'b1;
        column <= s_column;
        line <= s_line;
        pixels <= s_pixels;
        left <= s_left;
        fence <= s_fence;
        z <= s_z;
        r <= s_r;
        g <= s_g;
        b <= s_b;
        if (s_first) begin
          dz <= step_z;
          dr <= step_r;
          dg <= step_g;
          db <= step_b;
        end
      end
    end
endmodule
