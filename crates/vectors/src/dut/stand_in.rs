//! Our design under the names of a user's: a module with the ports of his, so that his own bench takes it.

use super::file::Dut;
use super::ports::Found;
use super::wiring::{Ends, Wire, Wiring};
use edgewalk_lockstep::{Direction, Interface, Link, Port};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Verilog of a module with the top module's name and ports, which holds ours of the unit. What the unit asks for and the
/// user's design has not is 0, a ready 1. No memory of the unit is inside the user's design.
#[must_use]
pub fn stand_in(interface: &Interface, wiring: &Wiring, found: &BTreeMap<String, Found>) -> String {
    let dut = &wiring.dut;
    let mut inside = Inside { found, text: String::new(), ports: vec![format!("clk({})", dut.clock)] };
    let level = if dut.reset.active_low { "!" } else { "" };
    inside.ports.push(format!("rst({level}{})", dut.reset.port));
    for (link, ends) in interface.links.iter().zip(&wiring.links) {
        inside.link(link, ends);
    }
    let inputs = interface.constants.iter().zip(&wiring.constants);
    for (port, wire) in inputs.chain(interface.levels.iter().zip(&wiring.levels)) {
        inside.single(port, wire, true);
    }
    for (status, wire) in interface.status.iter().zip(&wiring.status) {
        inside.single(&status.port, wire, false);
    }
    let list =
        |ports: &[String]| ports.iter().map(|port| format!("    .{port}")).collect::<Vec<_>>().join(",\n");
    format!(
        "// The reference of {} under the names of {}.\nmodule {} {}(\n{}\n);\n{}  {} reference (\n{}\n  );\nendmodule\n",
        interface.unit.name(),
        dut.top,
        dut.top,
        parameters(dut),
        declared(found),
        inside.text,
        interface.unit.module(),
        list(&inside.ports)
    )
}

fn parameters(dut: &Dut) -> String {
    let each = dut.parameters.iter().map(|(name, value)| format!("parameter {name} = {value}"));
    let each: Vec<String> = each.collect();
    if each.is_empty() { String::new() } else { format!("#({}) ", each.join(", ")) }
}

fn declared(found: &BTreeMap<String, Found>) -> String {
    let port = |(name, port): (&String, &Found)| {
        let way = if port.input { "input" } else { "output" };
        format!("    {way} wire [{}:0] {name}", port.width.max(1) - 1)
    };
    found.iter().map(port).collect::<Vec<_>>().join(",\n")
}

struct Inside<'a> {
    found: &'a BTreeMap<String, Found>,
    text: String,
    ports: Vec<String>,
}

impl Inside<'_> {
    fn link(&mut self, link: &Link, ends: &Ends) {
        let (name, input) = (link.name, link.direction == Direction::In);
        self.ports.push(format!("{name}_valid({})", ends.valid.as_deref().unwrap_or_default()));
        self.ports.push(match (&ends.ready, input) {
            (Some(ready), _) => format!("{name}_ready({ready})"),
            (None, true) => format!("{name}_ready()"),
            (None, false) => format!("{name}_ready(1'b1)"),
        });
        for (port, wire) in link.fields.iter().zip(&ends.fields) {
            self.single(port, wire, input);
        }
        let Some(packed) = &ends.packed else { return };
        let mut low = 0;
        for place in packed.order.iter().rev() {
            let field = &link.fields[*place];
            self.ports.push(format!("{}({}[{}:{low}])", field.name, packed.name, low + field.width() - 1));
            low += field.width();
        }
        self.above(&packed.name, low, "1'b0", input);
    }

    fn single(&mut self, port: &Port, wire: &Wire, input: bool) {
        match wire {
            Wire::Packed => {}
            Wire::Absent if input => self.ports.push(format!("{}({}'b0)", port.name, port.width())),
            Wire::Absent => self.ports.push(format!("{}()", port.name)),
            Wire::Port { name, .. } => {
                let top = port.width() - 1;
                self.ports.push(format!("{}({name}[{top}:0])", port.name));
                let sign = if port.is_signed() { format!("{name}[{top}]") } else { "1'b0".to_owned() };
                self.above(name, port.width(), &sign, input);
            }
        }
    }

    /// The bits of an output above its value.
    fn above(&mut self, name: &str, width: u32, sign: &str, input: bool) {
        let there = self.found.get(name).map_or(width, |found| found.width);
        if !input && there > width {
            let _ = writeln!(
                self.text,
                "  assign {name}[{}:{width}] = {{{}{{{sign}}}}};",
                there - 1,
                there - width
            );
        }
    }
}
