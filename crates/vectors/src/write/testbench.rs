//! `tb.v`: a self-checking test bench in plain Verilog-2001, made of the modules in `bench/`.

use super::device::{self, Device};
use super::faults;
use super::kept;
use crate::dut::Wiring;
use crate::seen::{Sight, sights};
use edgewalk_lockstep::{Direction, Interface, Link, Memory, Port, StatusPort, status_ports};
use edgewalk_machine::Plan;
use std::fmt::Write as _;

/// The modules that every test bench uses, file name and text.
const MODULES: [(&str, &str); 6] = [
    ("bench_pattern.v", include_str!("../../bench/bench_pattern.v")),
    ("bench_source.v", include_str!("../../bench/bench_source.v")),
    ("bench_taker.v", include_str!("../../bench/bench_taker.v")),
    ("bench_sink.v", include_str!("../../bench/bench_sink.v")),
    ("bench_change.v", include_str!("../../bench/bench_change.v")),
    ("bench_memory.v", include_str!("../../bench/bench_memory.v")),
];

/// The module that a bench for a user's design uses beside them.
const OWN_MODULE: (&str, &str) = ("bench_hold.v", include_str!("../../bench/bench_hold.v"));

/// The module that the bench of a unit uses which holds values beside a channel.
const HELD_MODULE: (&str, &str) = ("bench_kept.v", include_str!("../../bench/bench_kept.v"));

/// The modules of a unit's bench, file name and text; `own`: for a user's design.
pub fn modules(interface: &Interface, own: bool) -> Vec<(&'static str, &'static str)> {
    let own = own.then_some(OWN_MODULE);
    let held = kept::all(interface).next().map(|_| HELD_MODULE);
    MODULES.into_iter().chain(own).chain(held).collect()
}

/// The test bench of a unit, or of the design that is wired to its ports; `known` are the channels out whose tokens have a
/// file of triangles.
#[must_use]
pub fn testbench(plan: &Plan, interface: &Interface, known: &[&str], wiring: Option<&Wiring>) -> String {
    let mut device =
        wiring.map_or_else(|| device::reference(interface), |wiring| device::own(interface, wiring));
    let mut text = header(plan, &device);
    for channel in &interface.links {
        text.push_str(&channel_wires(channel));
    }
    for (place, channel) in interface.links.iter().enumerate() {
        text.push_str(&channel_end(interface, channel, asked(wiring, place)));
        if channel.direction == Direction::Out {
            text.push_str(&faults::telling(
                channel.name,
                "token",
                &channel.fields,
                known.contains(&channel.name),
            ));
        }
    }
    let (watched, unkept) = kept::section(interface, wiring);
    text.push_str(&watched);
    device.wrong.extend(unkept);
    text.push_str(&status_section(interface, &super::status_fields(interface)));
    text.push_str(&levels_section(interface));
    text.push_str(&device.instance);
    let counted = wiring.map(|wiring| counted(plan, interface, wiring)).unwrap_or_default();
    text.push_str(&events_section(&counted));
    text.push_str(&end_section(interface, &device, &counted, wiring));
    text
}

/// The events that the ports of a user's design show in single cycles, with the condition for each.
fn counted(plan: &Plan, interface: &Interface, wiring: &Wiring) -> Vec<(&'static str, String)> {
    let events = interface.unit.events(plan).into_iter().map(|event| event.name);
    let seen = sights(interface, wiring, events).into_iter();
    let counted = seen.filter_map(|(event, sight)| match sight {
        Sight::Cycles(condition) => Some((event, condition)),
        Sight::Tokens | Sight::Hidden(_) => None,
    });
    counted.collect()
}

fn events_section(counted: &[(&str, String)]) -> String {
    let mut text = String::new();
    if !counted.is_empty() {
        text.push_str("\n    // Events that the ports show.\n");
    }
    for (event, condition) in counted {
        let _ = writeln!(
            text,
            "    reg  [31:0] met_{event} = 0;\n    always @(posedge clk) if (!rst && compared && ({condition})) met_{event} <= met_{event} + 1;"
        );
    }
    text
}

fn header(plan: &Plan, device: &Device) -> String {
    let (cycles, bits) = &device.resets;
    let (clocks, counter) = match cycles.as_str() {
        "3" => ("Three clocks".to_owned(), format!("reg [{}:0]  resets = 3;", bits - 1)),
        "1" => ("One clock".to_owned(), "reg        resets = 1;".to_owned()),
        more => (format!("{more} clocks"), format!("reg [{}:0]  resets = {more};", bits - 1)),
    };
    let order = if device.order_only { "`define ORDER_ONLY // compare = \"order\"\n" } else { "" };
    HEADER
        .replace("{module}", &device.module)
        .replace("{order}", order)
        .replace("{clocks}", &clocks)
        .replace("{counter}", &counter)
        .replace("{cycles}", cycles)
        .replace("{mark}", &super::mark(&plan.hash()))
}

const HEADER: &str = r#"// Replays the tokens of the .in.mem files into {module} and compares everything that comes out with
// the .exp.mem files: every token in order, the cycle in which it moves (.cyc.mem), and the outputs of status.exp.mem
// in every cycle. Missing and extra outputs, unknown bits and an empty comparison fail too.
// Each line that the bench prints begins with "{mark}"; the last ones say "checked n / expected" and PASS or FAIL.
//
// Defined, ORDER_ONLY is for a design with other timing: only the order and the values of the tokens count then, and its
// status ports, which it need not have, stay open. `make CHECK_CYCLES=0` defines it.
{order}`timescale 1ns / 1ps
`default_nettype none
module tb;
`ifdef ORDER_ONLY
    localparam CHECK_CYCLES = 0;
`else
    localparam CHECK_CYCLES = 1;
`endif
    localparam SHOWN = 5; // faults of a channel that are told

`include "params.vh"
`include "cases.vh"

    // {clocks} of reset; cycle 0 is the first without. A first run, in which no ready comes before its valid, ends with a
    // second reset. From when each channel out has offered a second token, no more is taken: the first would not be told from
    // that of the run behind the reset. The reset comes when on each a token waits, or nothing happens any more. Of the
    // first run only order and values of the tokens count.
    reg        clk = 1'b0;
    {counter}
    reg        compared = 1'b0;
    wire       rst = resets != 0;
    wire       first_ends, all_ahead;
    reg [31:0] cycle = 0;
    always #5 clk = !clk;
    always @(posedge clk)
        if (first_ends) begin
            resets   <= {cycles};
            compared <= 1'b1;
            cycle    <= 0;
        end
        else if (rst) resets <= resets - 1;
        else cycle <= cycle + 1;
"#;

fn channel_wires(channel: &Link) -> String {
    let (name, upper) = (channel.name, channel.name.to_uppercase());
    let short = |f: &Port| f.field.name.clone();
    let fields: Vec<String> = channel.fields.iter().map(short).collect();
    let way = if channel.direction == Direction::In { "in" } else { "out" };
    format!(
        "\n    // {name}, {way}: {}\n    wire {name}_valid, {name}_ready, {name}_fire;\n    wire [{upper}_WIDTH-1:0] {name}_token;\n",
        wrapped(&fields, 100, "    //   ")
    )
}

/// The bench's end of a channel.
fn channel_end(interface: &Interface, channel: &Link, asked: bool) -> String {
    let served = interface.memories.iter().find(|memory| interface.links[memory.data].name == channel.name);
    let end = match (channel.direction, served) {
        (Direction::In, Some(memory)) => memory_end(interface, memory),
        (Direction::In, None) => SOURCE.to_owned(),
        (Direction::Out, _) => {
            let (willing, shy) = if asked { ("{name}_willing", "!compared") } else { ("1'b1", "1'b0") };
            SINK.replace("{willing}", willing).replace("{shy}", shy)
        }
    };
    of_link(&(PATTERN.to_owned() + &end), channel)
}

/// A design without a ready gives its tokens whether anybody is willing or not.
fn asked(wiring: Option<&Wiring>, place: usize) -> bool {
    wiring.is_none_or(|wiring| wiring.links[place].ready.is_some())
}

fn of_link(template: &str, link: &Link) -> String {
    template.replace("{name}", link.name).replace("{NAME}", &link.name.to_uppercase())
}

const PATTERN: &str = r#"
    wire {name}_willing;
    bench_pattern #(.PERIOD({NAME}_PERIOD), .BITS("{name}.willing.mem")) {name}_pattern (
        .cycle(cycle), .willing({name}_willing)
    );
"#;

const SOURCE: &str = r#"    wire {name}_more;
    bench_source #(.WIDTH({NAME}_WIDTH), .COUNT({NAME}_COUNT), .TOKENS("{name}.in.mem")) {name}_source (
        .clk(clk), .rst(rst), .willing({name}_willing),
        .valid({name}_valid), .ready({name}_ready), .data({name}_token), .fire({name}_fire),
        .more({name}_more)
    );
"#;

const SINK: &str = r#"    wire [31:0] {name}_checked, {name}_wrong, {name}_due;
    wire [2:0]  {name}_fault;
    wire [{NAME}_WIDTH-1:0] {name}_want;
    wire {name}_offered, {name}_ahead;
    bench_taker #(.COUNT({NAME}_COUNT)) {name}_taker (
        .clk(clk), .rst(rst), .shy({shy}), .keep(all_ahead && !compared), .willing({willing}),
        .valid({name}_valid), .ready({name}_ready), .offered({name}_offered), .ahead({name}_ahead)
    );
    assign {name}_fire  = !rst && {name}_valid && {name}_ready;
    bench_sink #(
        .WIDTH({NAME}_WIDTH), .COUNT({NAME}_COUNT), .CHECK_CYCLES(CHECK_CYCLES),
        .TOKENS("{name}.exp.mem"), .CYCLES("{name}.cyc.mem")
    ) {name}_sink (
        .clk(clk), .rst(rst), .cycle(cycle), .fire({name}_fire), .data({name}_token),
        .checked({name}_checked), .wrong({name}_wrong), .fault({name}_fault), .want({name}_want), .due({name}_due)
    );
    reg [1:0] {name}_early = 2'd0; // in the first run: 1 an unknown valid, 2 a token that is not the next one
    always @(posedge clk)
        if (!rst && !compared && {name}_early == 0)
            if ({name}_valid !== 1'b0 && {name}_valid !== 1'b1) {name}_early <= 2'd1;
            else if ({name}_fault != 0 && {name}_fault != 4) {name}_early <= 2'd2;
"#;

/// The memory whose words are this link.
fn memory_end(interface: &Interface, memory: &Memory) -> String {
    let read = interface.links[memory.read].name;
    let (write, address, data) = match &memory.write {
        None => ("1'b0".to_owned(), "0".to_owned(), "0".to_owned()),
        Some(write) => {
            let link = &interface.links[write.link];
            let bits = |field: usize| {
                let low: u32 = link.fields[field + 1..].iter().map(Port::width).sum();
                format!("{}_token[{}:{low}]", link.name, low + link.fields[field].width() - 1)
            };
            let enable = write.enable.map_or_else(String::new, |enable| format!(" && {}", bits(enable)));
            let write_now = format!("{}_fire{enable}", link.name);
            (write_now, bits(write.address), bits(write.word))
        }
    };
    // Words of its own, for a memory that nobody writes.
    let start = if memory.write.is_none() {
        ",\n        .STARTS({MEMORY}_START), .START(\"{memory}.start.mem\")"
    } else {
        ""
    };
    MEMORY
        .replace("{start}", start)
        .replace("{memory}", memory.name)
        .replace("{MEMORY}", &memory.name.to_uppercase())
        .replace("{read}", read)
        .replace("{READ}", &read.to_uppercase())
        .replace("{write}", &write)
        .replace("{address}", &address)
        .replace("{data}", &data)
}

const MEMORY: &str = r#"    bench_memory #(
        .ADDRESS({READ}_WIDTH), .WIDTH({NAME}_WIDTH), .LATENCY({MEMORY}_LATENCY), .CLEAR({MEMORY}_CLEAR){start}
    ) {memory}_memory (
        .clk(clk), .rst(rst), .cycle(cycle), .willing({name}_willing),
        .read({read}_fire), .read_address({read}_token),
        .write({write}), .write_address({address}), .write_data({data}),
        .valid({name}_valid), .ready({name}_ready), .data({name}_token), .fire({name}_fire)
    );
"#;

fn status_section(interface: &Interface, fields: &[Port]) -> String {
    let ports: Vec<String> = status_ports(interface).iter().map(StatusPort::expression).collect();
    let mut text = String::from("\n    // Outputs that are compared in every cycle.\n");
    for status in &interface.status {
        let _ = writeln!(text, "    wire {}{};", range(&status.port), status.port.name);
    }
    let _ = writeln!(text, "    wire [STATUS_WIDTH-1:0] status = {{{}}};", ports.join(", "));
    text.push_str(
        r#"    wire        status_change;
    wire        status_fire = status_change && CHECK_CYCLES != 0;
    wire [31:0] status_checked, status_wrong, status_due;
    wire [2:0]  status_fault;
    wire [STATUS_WIDTH-1:0] status_want;
    bench_change #(.WIDTH(STATUS_WIDTH)) status_watch (
        .clk(clk), .rst(rst), .value(status), .fire(status_change)
    );
    bench_sink #(
        .WIDTH(STATUS_WIDTH), .COUNT(STATUS_COUNT),
        .TOKENS("status.exp.mem"), .CYCLES("status.cyc.mem")
    ) status_sink (
        .clk(clk), .rst(rst), .cycle(cycle), .fire(status_fire), .data(status),
        .checked(status_checked), .wrong(status_wrong), .fault(status_fault), .want(status_want), .due(status_due)
    );
"#,
    );
    text.push_str(&faults::telling("status", "", fields, false));
    text
}

fn levels_section(interface: &Interface) -> String {
    let mut text = String::new();
    let Some(source) = interface.links.first() else { return text };
    for level in &interface.levels {
        let (name, upper) = (&level.name, level.name.to_uppercase());
        let _ = writeln!(text, "\n    // {}", level.field);
        text.push_str(PATTERN.replace("{name}", name).replace("{NAME}", &upper).trim_start_matches('\n'));
        let _ = writeln!(text, "    wire {name} = {}_more && !{name}_willing;", source.name);
    }
    text
}

/// `[3:0] `, or nothing for one bit.
fn range(field: &Port) -> String {
    if field.width() == 1 { String::new() } else { format!("[{}:0] ", field.width() - 1) }
}

fn end_section(
    interface: &Interface,
    device: &Device,
    counted: &[(&str, String)],
    wiring: Option<&Wiring>,
) -> String {
    let out: Vec<&str> = interface.links_of(Direction::Out).map(|link| link.name).collect();
    let sum =
        |suffix: &str| out.iter().map(|name| format!("{name}_{suffix}")).collect::<Vec<_>>().join(" + ");
    let counts =
        out.iter().map(|name| format!("{}_COUNT", name.to_uppercase())).collect::<Vec<_>>().join(" + ");
    let fires: Vec<String> = interface.links.iter().map(|link| format!("{}_fire", link.name)).collect();
    let every = out.iter().map(|name| format!("({name}_ahead || {}_COUNT == 0)", name.to_uppercase()));
    let every = every.collect::<Vec<_>>().join(" && ");
    let links = interface.links.iter().zip(0..).filter(|(link, _)| link.direction == Direction::Out);
    let asked: Vec<&Link> = links.filter(|(_, place)| asked(wiring, *place)).map(|(link, _)| link).collect();
    let stuck = asked.iter().map(|link| of_link(STUCK, link)).collect::<String>();
    let waited = asked.iter().map(|link| of_link(WAITED, link)).collect::<String>();
    let mut missing = String::new();
    for name in out.iter().chain([&"status"]) {
        let (upper, condition) =
            (name.to_uppercase(), if *name == "status" { "CHECK_CYCLES != 0 && " } else { "" });
        let _ = writeln!(missing, "        if ({condition}{name}_checked != {upper}_COUNT) {name}_missing;");
    }
    let met =
        counted.iter().map(|(event, _)| format!("        $display(\"met {event} %0d\", met_{event});\n"));
    let waits = asked.iter().map(|link| format!("{}_waits", link.name)).collect();
    let early = out.iter().map(|name| format!("({name}_early != 0 ? 1 : 0)")).collect();
    let wrong = [vec![sum("wrong")], device.wrong.clone(), waits, early].concat().join(" + ");
    let known = asked
        .iter()
        .map(|link| of_link("({name}_valid === 1'b1 || {NAME}_COUNT == 0)", link))
        .collect::<Vec<_>>();
    let known = if known.is_empty() { "1'b1".to_owned() } else { known.join(" && ") };
    let early = out.iter().map(|name| EARLY.replace("{name}", name)).collect::<String>();
    END.replace("{ports}", &port_widths(device))
        .replace("{checked}", &sum("checked"))
        .replace("{wrong}", &wrong)
        .replace("{counts}", &counts)
        .replace("{fires}", &fires.join(" || "))
        .replace("{missing}", &missing)
        .replace("{every}", &every)
        .replace("{known}", &known)
        .replace("{early}", &early)
        .replace("{stuck}", &stuck)
        .replace("{waited}", &waited)
        .replace("{met}", &met.collect::<String>())
}

/// The check that every port of the design has the width of its values: a simulator would only cut them, and warn.
fn port_widths(device: &Device) -> String {
    let line = |(name, width): &(String, u32)| {
        format!("        port_has(\"{name}\", $bits(dut.{name}), {width});\n")
    };
    let all = device.ports.iter().chain(&device.status);
    let longest = all.map(|(name, _)| name.len()).max().unwrap_or(1);
    let lines = |ports: &[(String, u32)]| ports.iter().map(line).collect::<String>();
    let status = match lines(&device.status) {
        none if none.is_empty() => none,
        some => format!("`ifndef ORDER_ONLY\n{some}`endif\n"),
    };
    PORTS
        .replace("{module}", &device.module)
        .replace("{bits}", &(8 * longest).to_string())
        .replace("{lines}", &(lines(&device.ports) + &status))
}

const PORTS: &str = r#"
    // A port of another width than its values would be cut or extended: the run ends before the first clock.
    reg unfit = 1'b0;
    task port_has; input [{bits}:1] name; input integer found, needed;
        if (found != needed) begin
            $display("port %0s of {module}: found %0d bits, needed %0d", name, found, needed);
            unfit = 1'b1;
        end
    endtask
    initial begin
{lines}        if (unfit) begin
            $display("checked 0 / %0d", EXPECTED);
            $display("FAIL: ports of another width; nothing was compared");
            $finish;
        end
    end
"#;

const END: &str = r#"
    // The end: nothing happens any more, or too much.
    localparam TOKENS   = {counts};
    localparam EXPECTED = TOKENS + (CHECK_CYCLES != 0 ? STATUS_COUNT : 0);
    wire [31:0] checked = {checked} + status_checked;
    wire [31:0] wrong   = {wrong} + status_wrong;
    wire        event_now = {fires} || status_change;
    reg  [31:0] quiet = 0;
    wire        at_end = !rst && (quiet == IDLE_LIMIT || cycle == CYCLE_LIMIT);
    assign all_ahead = {every};
    assign first_ends = !rst && !compared && (at_end || (all_ahead && {known}));
{stuck}    always @(posedge clk) begin
        quiet <= rst || event_now ? 0 : quiet + 1;
        if (compared && at_end) finish_run;
    end

{ports}
    task finish_run; begin
{missing}{waited}{early}        if (cycle == CYCLE_LIMIT) $display("still busy after %0d cycles", cycle);
{met}        $display("cycles %0d", cycle - quiet);
        $display("wrong %0d", wrong);
        $display("checked %0d / %0d", checked, EXPECTED);
        if (TOKENS == 0) $display("FAIL: nothing was compared");
        else if (wrong !== 0 || checked != EXPECTED || cycle == CYCLE_LIMIT) $display("FAIL");
        else $display("PASS");
        $finish;
    end endtask
endmodule
`default_nettype wire
"#;

/// In the first run all was quiet before the channel offered its first token.
const STUCK: &str = r#"    reg         {name}_stuck = 1'b0;
    wire [31:0] {name}_waits = {name}_stuck && {name}_checked != 0 ? 1 : 0;
    always @(posedge clk)
        if (first_ends) {name}_stuck <= quiet === IDLE_LIMIT && !{name}_offered && {NAME}_COUNT != 0;
"#;

const WAITED: &str = r#"        if ({name}_waits != 0) begin
            $display("{name}: {name}_valid waits for {name}_ready, which it must not:");
            $display("    no token was offered in the first run, in which {name}_ready is 0 until {name}_valid is 1");
        end
"#;

/// The first run found a fault of the channel.
const EARLY: &str = r#"        if ({name}_early == 1)
            $display("{name}: {name}_valid was unknown in the first run: does the reset reach {name}_valid?");
        if ({name}_early == 2)
            $display("{name}: a token of the first run is not the next one: does the reset reach {name}_valid?");
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
