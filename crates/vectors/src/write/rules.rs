//! `rules.v`, `rules_bind.sv`, `rules_icarus.v`: what holds on each channel, as modules that look at a design from inside any test
//! bench.

use crate::dut::Wiring;
use crate::manifest::DutInfo;
use edgewalk_lockstep::{Direction, Interface, Link};
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

fn name(interface: &Interface, link: &Link) -> String {
    format!("{}_{}_rules", interface.unit.module(), link.name)
}

fn modules(interface: &Interface) -> String {
    let mut text = HEAD.replace("{design}", &interface.unit.module());
    for link in &interface.links {
        let who = match link.direction {
            Direction::In => "Whoever drives the design keeps the first two",
            Direction::Out => "The design keeps the first two",
        };
        let range = |width: u32| if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) };
        let ports: Vec<String> = link
            .fields
            .iter()
            .map(|field| format!("    input wire {}{}", range(field.width()), field.name))
            .collect();
        let token: Vec<&str> = link.fields.iter().map(|field| field.name.as_str()).collect();
        text += &MODULE
            .replace("{module}", &name(interface, link))
            .replace("{who}", who)
            .replace("{name}", link.name)
            .replace("{ports}", &ports.join(",\n"))
            .replace("{token}", &token.join(", "))
            .replace("{top}", &(link.width() - 1).to_string());
    }
    text + "`default_nettype wire\n"
}

const HEAD: &str = r#"// What holds on each channel of {design}, a module a channel. Plain Verilog-2001.
// rules_bind.sv binds them into the design, where the simulator has `bind`. Icarus has none: there rules_icarus.v is a second
// top module beside the test bench. A broken rule prints a line that begins with "rule broken:", and `broken` counts it.
// The first token of a channel prints a line too: so it is seen that the rules are at work.
`timescale 1ns / 1ps
`default_nettype none
"#;

const MODULE: &str = r#"
// Channel {name}. {who}.
module {module} (
    input wire clk,
    input wire rst,
    input wire {name}_valid,
    input wire {name}_ready,
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
            // 3. No unknown bit in the handshake, or in a token that moves. Verilator has no unknown bits.
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

/// The instance of a channel's rules.
fn instance(interface: &Interface, link: &Link, places: &Places, scope: &str) -> String {
    let (clock, reset) = places.clock_and_reset(scope);
    let mut ports = vec![format!(".clk({clock})"), format!(".rst({reset})")];
    let ends = ["valid", "ready"].map(|end| (format!("{}_{end}", link.name), 1));
    let fields = link.fields.iter().map(|field| (field.name.clone(), field.width()));
    let all = ends.into_iter().chain(fields);
    ports.extend(all.map(|(port, width)| format!(".{port}({})", places.value(&port, width, scope))));
    format!("{} {}_rules (\n    {}\n);\n", name(interface, link), link.name, ports.join(",\n    "))
}

fn bind(interface: &Interface, design: &str, places: &Places) -> String {
    let mut text = format!(
        "// SystemVerilog: the rules of rules.v in every {design}. Compile both files beside any test bench.\n"
    );
    for link in &interface.links {
        // Writing to a string cannot fail.
        let _ = write!(text, "\nbind {design} {}", instance(interface, link, places, ""));
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
    for link in &interface.links {
        let _ = write!(text, "\n{}", instance(interface, link, places, "`DESIGN."));
    }
    text + "endmodule\n"
}
