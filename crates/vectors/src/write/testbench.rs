//! `tb.v`: a self-checking test bench in plain Verilog-2001, made of the modules in `bench/`.

use crate::ports::{Channel, Direction, Field, Interface};
use crate::status::{StatusPort, status_ports};
use std::fmt::Write as _;

/// The modules that every test bench uses, file name and text.
pub const MODULES: [(&str, &str); 4] = [
    ("bench_source.v", include_str!("../../bench/bench_source.v")),
    ("bench_sink.v", include_str!("../../bench/bench_sink.v")),
    ("bench_change.v", include_str!("../../bench/bench_change.v")),
    ("bench_memory.v", include_str!("../../bench/bench_memory.v")),
];

/// The test bench of a unit.
#[must_use]
pub fn testbench(interface: &Interface) -> String {
    let mut text = HEADER.replace("{module}", &interface.unit.module());
    for channel in &interface.channels {
        text.push_str(&channel_wires(channel));
    }
    for channel in &interface.channels {
        text.push_str(&channel_end(interface, channel));
    }
    text.push_str(&status_section(interface));
    text.push_str(&levels_section(interface));
    text.push_str(&device_section(interface));
    text.push_str(&end_section(interface));
    text
}

const HEADER: &str = r#"// Replays the tokens of the .in.mem files into {module} and compares everything that comes out with
// the .exp.mem files: every token in order, the cycle in which it moves (.cyc.mem), and the outputs of status.exp.mem
// in every cycle. Missing and extra outputs, unknown bits and an empty comparison fail too.
// The last lines say "checked n / expected" and PASS or FAIL.
`default_nettype none
module tb;
    // 0 for a design with other timing: then only the order and the values of the tokens count.
    parameter CHECK_CYCLES = 1;

`include "params.vh"

    // Three clocks of reset; cycle 0 is the first without.
    reg        clk = 1'b0;
    reg [1:0]  resets = 3;
    wire       rst = resets != 0;
    reg [31:0] cycle = 0;
    always #5 clk = !clk;
    always @(posedge clk)
        if (rst) resets <= resets - 1;
        else cycle <= cycle + 1;
"#;

fn channel_wires(channel: &Channel) -> String {
    let (name, upper) = (channel.name, channel.name.to_uppercase());
    let short = |f: &Field| f.port.strip_prefix(name).map_or(f.port.clone(), |f| f[1..].to_owned());
    let fields: Vec<String> = channel.fields.iter().map(short).collect();
    let way = if channel.direction == Direction::In { "in" } else { "out" };
    format!(
        "\n    // {name}, {way}: {}\n    wire {name}_valid, {name}_ready, {name}_fire;\n    wire [{upper}_WIDTH-1:0] {name}_token;\n",
        wrapped(&fields, 100, "    //   ")
    )
}

/// The bench's end of a channel.
fn channel_end(interface: &Interface, channel: &Channel) -> String {
    let end = match channel.direction {
        Direction::In if interface.memory && channel.name == "data" => MEMORY,
        Direction::In => SOURCE,
        Direction::Out => SINK,
    };
    end.replace("{name}", channel.name).replace("{NAME}", &channel.name.to_uppercase())
}

const SOURCE: &str = r#"
    wire {name}_more;
    bench_source #(
        .WIDTH({NAME}_WIDTH), .COUNT({NAME}_COUNT), .PERIOD({NAME}_PERIOD), .PATTERN({NAME}_PATTERN),
        .TOKENS("{name}.in.mem")
    ) {name}_source (
        .clk(clk), .rst(rst), .cycle(cycle),
        .valid({name}_valid), .ready({name}_ready), .data({name}_token), .fire({name}_fire),
        .more({name}_more)
    );
"#;

const SINK: &str = r#"
    wire [31:0] {name}_checked, {name}_wrong;
    assign {name}_ready = {NAME}_PATTERN[cycle % {NAME}_PERIOD];
    assign {name}_fire  = !rst && {name}_valid && {name}_ready;
    bench_sink #(
        .NAME("{name}"), .WIDTH({NAME}_WIDTH), .COUNT({NAME}_COUNT), .CHECK_CYCLES(CHECK_CYCLES),
        .TOKENS("{name}.exp.mem"), .CYCLES("{name}.cyc.mem")
    ) {name}_sink (
        .clk(clk), .rst(rst), .cycle(cycle), .fire({name}_fire), .data({name}_token),
        .checked({name}_checked), .wrong({name}_wrong)
    );
"#;

/// The fields of `wr` are addr, z, z_en, …: the top of the token.
const MEMORY: &str = r#"
    bench_memory #(
        .ADDRESS(RD_WIDTH), .WIDTH(DATA_WIDTH), .LATENCY(LATENCY), .CLEAR(CLEAR_Z),
        .PERIOD(DATA_PERIOD), .PATTERN(DATA_PATTERN)
    ) memory (
        .clk(clk), .rst(rst), .cycle(cycle),
        .read(rd_fire), .read_address(rd_token),
        .write(wr_fire && wr_token[WR_WIDTH-RD_WIDTH-DATA_WIDTH-1]),
        .write_address(wr_token[WR_WIDTH-1 -: RD_WIDTH]), .write_data(wr_token[WR_WIDTH-RD_WIDTH-1 -: DATA_WIDTH]),
        .valid(data_valid), .ready(data_ready), .data(data_token), .fire(data_fire)
    );
"#;

fn status_section(interface: &Interface) -> String {
    let ports: Vec<String> = status_ports(interface).iter().map(StatusPort::expression).collect();
    let mut text = String::from("\n    // Outputs that are compared in every cycle.\n");
    for status in &interface.status {
        let field = &status.field;
        let _ = writeln!(text, "    wire {}{};", range(field), field.port);
    }
    let _ = writeln!(text, "    wire [STATUS_WIDTH-1:0] status = {{{}}};", ports.join(", "));
    text.push_str(
        r#"    wire        status_change;
    wire        status_fire = status_change && CHECK_CYCLES != 0;
    wire [31:0] status_checked, status_wrong;
    bench_change #(.WIDTH(STATUS_WIDTH)) status_watch (
        .clk(clk), .rst(rst), .value(status), .fire(status_change)
    );
    bench_sink #(
        .NAME("status"), .WIDTH(STATUS_WIDTH), .COUNT(STATUS_COUNT),
        .TOKENS("status.exp.mem"), .CYCLES("status.cyc.mem")
    ) status_sink (
        .clk(clk), .rst(rst), .cycle(cycle), .fire(status_fire), .data(status),
        .checked(status_checked), .wrong(status_wrong)
    );
"#,
    );
    text
}

fn levels_section(interface: &Interface) -> String {
    let mut text = String::new();
    let Some(source) = interface.channels.first() else { return text };
    for level in &interface.levels {
        let (name, upper) = (&level.port, level.port.to_uppercase());
        let _ = writeln!(
            text,
            "\n    // {}\n    wire {name} = {}_more && !{upper}_PATTERN[cycle % {upper}_PERIOD];",
            level.format, source.name
        );
    }
    text
}

/// `[3:0] `, or nothing for one bit.
fn range(field: &Field) -> String {
    if field.width == 1 { String::new() } else { format!("[{}:0] ", field.width - 1) }
}

fn device_section(interface: &Interface) -> String {
    let mut ports = vec!["clk(clk)".to_owned(), "rst(rst)".to_owned()];
    for channel in &interface.channels {
        let name = channel.name;
        ports.push(format!("{name}_valid({name}_valid)"));
        ports.push(format!("{name}_ready({name}_ready)"));
        let mut high = channel.width();
        for field in &channel.fields {
            ports.push(format!("{}({name}_token[{}:{}])", field.port, high - 1, high - field.width));
            high -= field.width;
        }
    }
    let constant = |field: &Field| format!("{}({})", field.port, field.port.to_uppercase());
    ports.extend(interface.constants.iter().map(constant));
    let status = interface.status.iter().map(|status| &status.field);
    ports.extend(interface.levels.iter().chain(status).map(|field| format!("{0}({0})", field.port)));
    let list: Vec<String> = ports.iter().map(|port| format!("        .{port}")).collect();
    format!("\n    // The design.\n    {} dut (\n{}\n    );\n", interface.unit.module(), list.join(",\n"))
}

fn end_section(interface: &Interface) -> String {
    let out: Vec<&str> = interface.channels_of(Direction::Out).map(|c| c.name).collect();
    let sum =
        |suffix: &str| out.iter().map(|name| format!("{name}_{suffix}")).collect::<Vec<_>>().join(" + ");
    let counts =
        out.iter().map(|name| format!("{}_COUNT", name.to_uppercase())).collect::<Vec<_>>().join(" + ");
    let fires: Vec<String> = interface.channels.iter().map(|c| format!("{}_fire", c.name)).collect();
    let mut missing = String::new();
    for name in out.iter().chain([&"status"]) {
        let (upper, condition) =
            (name.to_uppercase(), if *name == "status" { "CHECK_CYCLES != 0 && " } else { "" });
        let _ = writeln!(
            missing,
            "        if ({condition}{name}_checked < {upper}_COUNT)\n            $display(\"{name}: %0d of %0d never came\", {upper}_COUNT - {name}_checked, {upper}_COUNT);"
        );
    }
    END.replace("{checked}", &sum("checked"))
        .replace("{wrong}", &sum("wrong"))
        .replace("{counts}", &counts)
        .replace("{fires}", &fires.join(" || "))
        .replace("{missing}", &missing)
}

const END: &str = r#"
    // The end: nothing happens any more, or too much.
    localparam TOKENS   = {counts};
    localparam EXPECTED = TOKENS + (CHECK_CYCLES != 0 ? STATUS_COUNT : 0);
    wire [31:0] checked = {checked} + status_checked;
    wire [31:0] wrong   = {wrong} + status_wrong;
    wire        event_now = {fires} || status_change;
    reg  [31:0] quiet = 0;
    always @(posedge clk) if (!rst) begin
        quiet <= event_now ? 0 : quiet + 1;
        if (quiet == IDLE_LIMIT || cycle == CYCLE_LIMIT) finish_run;
    end

    task finish_run; begin
{missing}        if (cycle == CYCLE_LIMIT) $display("still busy after %0d cycles", cycle);
        $display("cycles %0d", cycle - quiet);
        $display("wrong %0d", wrong);
        $display("checked %0d / %0d", checked, EXPECTED);
        if (TOKENS == 0) $display("FAIL: nothing was compared");
        else if (wrong != 0 || checked != EXPECTED || cycle == CYCLE_LIMIT) $display("FAIL");
        else $display("PASS");
        $finish;
    end endtask
endmodule
`default_nettype wire
"#;

/// Words with spaces between, broken at about `width` characters.
fn wrapped(words: &[String], width: usize, indent: &str) -> String {
    let mut text = String::new();
    let mut column = 0;
    for word in words {
        if column > width {
            text.push('\n');
            text.push_str(indent);
            column = 0;
        } else if column > 0 {
            text.push(' ');
        }
        text.push_str(word);
        column += word.len() + 1;
    }
    text
}
