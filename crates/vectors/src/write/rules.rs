//! `rules.v`, `rules_bind.sv`, `rules_icarus.v`: what holds on each channel, as modules that look at a design from inside any test
//! bench.

use super::kept::{self, Kept};
use crate::dut::Wiring;
use crate::manifest::DutInfo;
use edgewalk_lockstep::{Direction, Interface, Link, Port};
use std::fmt::Write as _;

/// The modules, one a channel.
pub const MODULES: &str = "rules.v";
/// What puts them into the design where a simulator has `bind`.
pub const BIND: &str = "rules_bind.sv";
/// A top module that looks at the design from outside, for a simulator without `bind`.
pub const OUTSIDE: &str = "rules_icarus.v";

/// The files, name and text.
pub fn files(interface: &Interface, wiring: Option<&Wiring>) -> [(&'static str, String); 3] {
    let places = Places { own: wiring.map(|wiring| super::dut::info(interface, wiring)) };
    let module = interface.unit.module();
    let design = wiring.map_or(module.as_str(), |wiring| &wiring.dut.top);
    [
        (MODULES, modules(interface)),
        (BIND, bind(interface, design, &places)),
        (OUTSIDE, outside(interface, design, &places)),
    ]
}

/// The module of a channel's rules, or of those of what is held beside it.
fn name(interface: &Interface, of: &str) -> String {
    format!("{}_{of}_rules", interface.unit.module())
}

fn ports(fields: &[(String, u32)]) -> String {
    let range = |width: u32| if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) };
    let ports = fields.iter().map(|(name, width)| format!("    input wire {}{name}", range(*width)));
    ports.collect::<Vec<_>>().join(",\n")
}

fn named(fields: &[Port]) -> Vec<(String, u32)> {
    fields.iter().map(|field| (field.name.clone(), field.width())).collect()
}

/// Valid, ready and fields of a channel.
fn of_channel(link: &Link) -> Vec<(String, u32)> {
    let ends = ["valid", "ready"].map(|end| (format!("{}_{end}", link.name), 1));
    ends.into_iter().chain(named(&link.fields)).collect()
}

/// What the rule of held values looks at: the handshakes and flags of both channels, and the values.
fn of_kept(kept: &Kept) -> Vec<(String, u32)> {
    let ends = |link: &Link| ["valid", "ready"].map(|end| (format!("{}_{end}", link.name), 1));
    let flags = std::iter::once(kept.fresh).chain(kept.ends).map(|port| (port.name.clone(), 1));
    let all = ends(kept.link).into_iter().chain(ends(kept.taken)).chain(flags);
    all.chain(named(kept.link.held())).collect()
}

fn modules(interface: &Interface) -> String {
    let mut text = HEAD.replace("{design}", &interface.unit.module());
    for link in &interface.links {
        let who = match link.direction {
            Direction::In => "Whoever drives the design keeps the first two",
            Direction::Out => "The design keeps the first two",
        };
        let token: Vec<&str> = link.fields.iter().map(|field| field.name.as_str()).collect();
        text += &MODULE
            .replace("{module}", &name(interface, link.name))
            .replace("{who}", who)
            .replace("{name}", link.name)
            .replace("{ports}", &ports(&of_channel(link)))
            .replace("{token}", &token.join(", "))
            .replace("{top}", &(link.width() - 1).to_string());
    }
    for kept in kept::all(interface) {
        let held: Vec<&str> = kept.link.held().iter().map(|port| port.name.as_str()).collect();
        let ends = kept.ends.map_or_else(String::new, |ends| format!(" && {}", ends.name));
        text += &KEPT
            .replace("{module}", &name(interface, &held_name(&kept)))
            .replace("{name}", kept.link.name)
            .replace("{taken}", kept.taken.name)
            .replace("{fresh}", &kept.fresh.name)
            .replace("{ends}", &ends)
            .replace("{ports}", &ports(&of_kept(&kept)))
            .replace("{values}", &held.join(", "))
            .replace("{top}", &(kept.link.held().iter().map(Port::width).sum::<u32>() - 1).to_string());
    }
    text + "`default_nettype wire\n"
}

fn held_name(kept: &Kept) -> String {
    format!("{}_held", kept.link.name)
}

const KEPT: &str = r#"
// Values held beside channel {name}: the design keeps the rule.
module {module} (
    input wire clk,
    input wire rst,
{ports}
);
    wire [{top}:0] values = {{values}};
    reg  [{top}:0] last;
    reg            kept = 1'b0;
    reg     [31:0] broken = 0;
    integer        ahead = 0;  // triangles taken, without those whose first token has moved
    wire           moved = {name}_valid && {name}_ready && {fresh};
    wire           taken = {taken}_valid && {taken}_ready{ends};
    integer        left;

    always @(posedge clk) begin
        last <= values;
        left = ahead + (taken ? 1 : 0) - (moved ? 1 : 0);
        kept  <= rst === 1'b0 && (kept || moved) && !taken && left <= 0;
        ahead <= rst === 1'b0 ? left : 0;
        // 4. Values stay: from the first token of a triangle on until the next triangle is taken.
        if (rst === 1'b0 && kept && values !== last) begin
            $display("rule broken: {name}: time %0t: a held value changed before the next triangle was taken", $time);
            broken <= broken + 1;
        end
    end
endmodule
"#;

const HEAD: &str = r#"// What holds on each channel of {design}, a module a channel. Plain Verilog-2001.
// rules_bind.sv binds them into the design, where the simulator has `bind`. Icarus has none: there rules_icarus.v is a second
// top module beside the test bench. A broken rule prints a line with "rule broken:", and `broken` counts it.
// The first token of a channel prints a line too: so it is seen that the rules are at work.
`timescale 1ns / 1ps
`default_nettype none
"#;

const MODULE: &str = r#"
// Channel {name}. {who}.
module {module} (
    input wire clk,
    input wire rst,
{ports}
);
    wire [{top}:0] token = {{token}};
    reg  [{top}:0] last;
    reg         waits = 1'b0;  // a token was offered in the clock before, and not taken
    reg         moved = 1'b0;
    reg  [31:0] broken = 0;

    always @(posedge clk) begin
        waits <= rst === 1'b0 && {name}_valid === 1'b1 && {name}_ready === 1'b0;
        last  <= token;
        if (rst === 1'b0) begin
            // 1. Valid holds: it stays high until the token is taken.
            if (waits && {name}_valid !== 1'b1) begin
                $display("rule broken: {name}: time %0t: valid fell before the token was taken", $time);
                broken <= broken + 1;
            end
            // 2. Data is stable: the token stays as it is until it is taken.
            else if (waits && token !== last) begin
                $display("rule broken: {name}: time %0t: the token changed before it was taken", $time);
                broken <= broken + 1;
            end
            // 3. No unknown bit in valid, in ready while valid is 1, or in a token that moves. Verilator has no unknown bits.
            else if ({name}_valid !== 1'b0 && ^{{name}_valid, {name}_ready} === 1'bx) begin
                $display("rule broken: {name}: time %0t: valid or ready is unknown", $time);
                broken <= broken + 1;
            end else if ({name}_valid && {name}_ready && ^token === 1'bx) begin
                $display("rule broken: {name}: time %0t: unknown bits in a token that moves: %h", $time, token);
                broken <= broken + 1;
            end
            if ({name}_valid === 1'b1 && {name}_ready === 1'b1 && !moved) begin
                moved <= 1'b1;
                $display("rules of {name}: at work");
            end
        end
    end
endmodule
"#;

/// Where the unit's ports are in the design.
struct Places {
    own: Option<DutInfo>,
}

impl Places {
    /// The value of a unit's port in Verilog; `scope` is what comes before the name of a port.
    fn value(&self, port: &str, width: u32, scope: &str) -> String {
        let Some(own) = &self.own else { return format!("{scope}{port}") };
        let Some(place) = own.ports.get(port) else {
            // A ready that is not there is always 1, a field counts as 0.
            return if port.ends_with("_ready") { "1'b1".to_owned() } else { format!("{width}'d0") };
        };
        let alone = own.ports.values().filter(|other| other.port == place.port).count() == 1;
        match (alone, width) {
            (true, 1) if place.width == 1 => format!("{scope}{}", place.port),
            _ => format!("{scope}{}[{}:{}]", place.port, place.lsb + width - 1, place.lsb),
        }
    }

    fn clock_and_reset(&self, scope: &str) -> (String, String) {
        match &self.own {
            None => (format!("{scope}clk"), format!("{scope}rst")),
            Some(own) => {
                let level = if own.reset.active == "low" { "!" } else { "" };
                (format!("{scope}{}", own.clock), format!("{level}{scope}{}", own.reset.port))
            }
        }
    }
}

/// The instances of all rules.
fn instances<'a>(
    interface: &'a Interface,
    places: &'a Places,
    scope: &'a str,
) -> impl Iterator<Item = String> + 'a {
    let channels = interface.links.iter().map(|link| (link.name.to_owned(), of_channel(link)));
    let held = kept::all(interface).map(|kept| (held_name(&kept), of_kept(&kept)));
    channels.chain(held).map(move |(of, ports)| instance(&name(interface, &of), &of, ports, places, scope))
}

fn instance(module: &str, of: &str, looked_at: Vec<(String, u32)>, places: &Places, scope: &str) -> String {
    let (clock, reset) = places.clock_and_reset(scope);
    let mut ports = vec![format!(".clk({clock})"), format!(".rst({reset})")];
    let values = looked_at.into_iter();
    ports.extend(values.map(|(port, width)| format!(".{port}({})", places.value(&port, width, scope))));
    format!("{module} {of}_rules (\n    {}\n);\n", ports.join(",\n    "))
}

fn bind(interface: &Interface, design: &str, places: &Places) -> String {
    let mut text = format!(
        "// SystemVerilog: the rules of rules.v in every {design}. Compile both files beside any test bench.\n"
    );
    for instance in instances(interface, places, "") {
        // Writing to a string cannot fail.
        let _ = write!(text, "\nbind {design} {instance}");
    }
    text
}

fn outside(interface: &Interface, design: &str, places: &Places) -> String {
    let top = format!("{}_rules", interface.unit.module());
    let mut text = format!(
        "// For Icarus, which has no `bind`: a second top module, which looks at {design} by its path. With another test bench\n\
         // than tb.v define the path:\n\
         //   iverilog -DDESIGN=my_bench.my_instance -s my_bench -s {top} ... rules.v rules_icarus.v\n\
         `ifndef DESIGN\n`define DESIGN tb.dut\n`endif\n`timescale 1ns / 1ps\nmodule {top};\n"
    );
    for instance in instances(interface, places, "`DESIGN.") {
        let _ = write!(text, "\n{instance}");
    }
    text + "endmodule\n"
}
