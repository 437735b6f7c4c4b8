//! A module from its header to `endmodule`.

use edgewalk_netlist::netlist::{Item, Netlist, Source};
use edgewalk_netlist::ops::Bits;

use crate::expression::Writer;
use crate::groups::Group;
use crate::interface::{header, is_shown, ports};
use crate::literal;
use crate::memory;
use crate::paragraph::{Body, LINE, columns};
use crate::usage::fanout;

/// The whole file.
pub(crate) fn print(netlist: &Netlist) -> String {
    let sections = sections(netlist);
    let groups = sections.iter().flat_map(|section| Group::of(netlist, &section.updates)).collect::<Vec<_>>();
    let mut printer =
        Printer { writer: Writer::new(netlist, fanout(netlist, &groups)), body: Body::default() };
    for section in &sections {
        printer.section(section);
    }
    printer.outputs();
    printer.unused();
    format!(
        "{}`timescale 1ns / 1ps\n`default_nettype none\n\nmodule {} (\n{});\n\n{}\n\nendmodule\n\n`default_nettype wire\n",
        header(netlist),
        netlist.name,
        ports(netlist),
        printer.body.finish()
    )
}

/// What stands between two comments.
#[derive(Default)]
struct Section<'n> {
    comment: Option<&'n str>,
    items: Vec<&'n Item>,
    /// Registers whose updates are complete here; they are told last.
    updates: Vec<usize>,
}

fn sections(netlist: &Netlist) -> Vec<Section<'_>> {
    let mut sections = vec![Section::default()];
    for item in &netlist.items {
        if let Item::Comment(text) = item {
            sections.push(Section { comment: Some(text), ..Section::default() });
        } else if let Some(section) = sections.last_mut() {
            match item {
                Item::Update(register) => section.updates.push(*register),
                _ => section.items.push(item),
            }
        }
    }
    sections
}

/// A list in lines, filled up to the usual length.
fn filled(parts: &[String]) -> String {
    let mut lines = vec![String::new()];
    for part in parts {
        let line = lines.last().map_or(0, |line| line.len());
        if line > 0 && line + part.len() > LINE {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if line.is_empty() { "  " } else { " " });
            line.push_str(part);
            line.push(',');
        }
    }
    let text = lines.join("\n");
    text.trim_end_matches(',').to_string()
}

struct Printer<'n> {
    writer: Writer<'n>,
    body: Body,
}

impl<'n> Printer<'n> {
    fn section(&mut self, section: &Section<'n>) {
        if let Some(comment) = section.comment {
            self.body.section(comment);
        }
        for item in &section.items {
            self.item(item);
        }
        for group in Group::of(self.writer.netlist, &section.updates) {
            group.print(&mut self.writer, &mut self.body);
        }
    }

    fn item(&mut self, item: &Item) {
        let netlist = self.writer.netlist;
        match item {
            // Told by section.
            Item::Comment(_) | Item::Update(_) => {}
            Item::Constant(id) => {
                if let Source::Constant { value, name: Some(name) } = &netlist.node(*id).source {
                    let bits = Bits { value: *value, width: netlist.width(*id) };
                    let range = literal::range(bits.width);
                    self.body.line(format!("localparam {range}{name} = {};", literal::unsigned(bits)), "");
                }
            }
            Item::Wire(index) => {
                let later = netlist.items.contains(&Item::Drive(*index));
                self.wire(*index, later);
            }
            Item::Drive(index) => self.drive(*index),
            Item::Register(index) => {
                let register = &netlist.registers[*index];
                if !is_shown(netlist, register.node) {
                    let range = literal::range(netlist.width(register.node));
                    self.body.line(format!("reg {range}{};", register.name), &register.doc);
                }
                if register.starts_at_zero {
                    let zero = literal::unsigned(Bits { value: 0, width: netlist.width(register.node) });
                    self.body.line(format!("initial {} = {zero};", register.name), "");
                }
            }
            Item::Memory(index) => {
                memory::declare(&mut self.writer, &mut self.body, &netlist.memories[*index]);
            }
            Item::MemoryWrite { memory: index, port } => {
                let memory = &netlist.memories[*index];
                if port + 1 == memory.writes.len() {
                    memory::writes(&mut self.writer, &mut self.body, memory);
                }
            }
            Item::MemoryRead { memory: index, port } => {
                let memory = &netlist.memories[*index];
                let declare = !is_shown(netlist, memory.reads[*port].node);
                memory::read(&mut self.writer, &mut self.body, memory, *port, declare);
            }
            Item::InstanceOutput(id) => {
                if let Some(name) = netlist.name_of(*id).filter(|_| !is_shown(netlist, *id)) {
                    self.body.line(format!("wire {}{name};", literal::range(netlist.width(*id))), "");
                }
            }
            Item::Instance(index) => self.instance(*index),
        }
    }

    fn wire(&mut self, index: usize, later: bool) {
        let netlist = self.writer.netlist;
        let wire = &netlist.wires[index];
        let declaration = format!("wire {}{}", literal::range(netlist.width(wire.node)), wire.name);
        match (is_shown(netlist, wire.node), later) {
            (true, true) => {}
            (true, false) => self.drive(index),
            (false, true) => self.body.line(declaration + ";", &wire.doc),
            (false, false) => {
                let before = declaration + " = ";
                let text = self.writer.driver(&mut self.body, &before, wire.node, wire.driver);
                self.body.line(text + ";", &wire.doc);
            }
        }
    }

    fn drive(&mut self, index: usize) {
        let wire = &self.writer.netlist.wires[index];
        let before = format!("assign {} = ", wire.name);
        let text = self.writer.driver(&mut self.body, &before, wire.node, wire.driver);
        self.body.line(text + ";", "");
    }

    fn instance(&mut self, index: usize) {
        let instance = &self.writer.netlist.instances[index];
        let module = &instance.module;
        let mut rows = Vec::new();
        for (port, there) in [("clk", module.has_clock), ("rst", module.has_reset)] {
            if there {
                rows.push((format!("  .{port}"), format!(" ({port})")));
            }
        }
        for (input, driver) in module.inputs.iter().zip(&instance.connections) {
            let value = self.writer.alone(&mut self.body, "", *driver);
            rows.push((format!("  .{}", input.name), format!(" ({value})")));
        }
        for (output, node) in module.outputs.iter().zip(&instance.outputs) {
            let name = node.and_then(|node| self.writer.netlist.name_of(node));
            let name = name.unwrap_or_else(|| {
                // Nobody asked for it: a wire that ends in `unused`.
                let name = self.writer.names.fresh(&format!("{}_{}_unused", instance.name, output.name));
                let range = literal::range(module.width(output.driver));
                self.body.line(format!("wire {range}{name};"), "");
                name
            });
            rows.push((format!("  .{}", output.name), format!(" ({name})")));
        }
        let mut lines = vec![format!("{} {} (", module.name, instance.name)];
        lines.extend(columns(&rows));
        lines.push(");".into());
        self.body.block(&lines);
    }

    /// What the output ports show, where they are not registers or wires themselves.
    fn outputs(&mut self) {
        let netlist = self.writer.netlist;
        for output in &netlist.outputs {
            if netlist.name_of(output.driver).as_ref() != Some(&output.name) {
                let before = format!("assign {} = ", output.name);
                let text = self.writer.alone(&mut self.body, &before, output.driver);
                self.body.line(text + ";", "");
            }
        }
    }

    /// A wire in which everything ends that the text does not mention, so that lint need not ask.
    fn unused(&mut self) {
        let netlist = self.writer.netlist;
        let named = netlist.ids().filter(|id| !is_shown(netlist, *id));
        let named = named.filter_map(|id| Some((id, netlist.name_of(id)?)));
        let made_up = self.writer.declared().map(|(id, name)| (id, name.to_string()));
        let mut parts = vec!["1'b0".to_string()];
        // Ports that a module has and that nothing in it needs.
        let implicit = [
            ("clk", netlist.has_clock && !netlist.needs_clock()),
            ("rst", netlist.has_reset && !netlist.needs_reset()),
        ];
        parts.extend(implicit.iter().filter(|(_, idle)| *idle).map(|(port, _)| (*port).to_owned()));
        for (id, name) in named.chain(made_up) {
            let width = netlist.width(id);
            let whole = [(width - 1, 0)];
            match &self.writer.mentioned.missing(id, width)[..] {
                ranges if ranges == whole => parts.push(name),
                ranges => parts.extend(ranges.iter().map(|(hi, lo)| match hi == lo {
                    true => format!("{name}[{hi}]"),
                    false => format!("{name}[{hi}:{lo}]"),
                })),
            }
        }
        if parts.len() > 1 {
            let list = parts.join(", ");
            let list = if list.len() < LINE { list } else { format!("\n{}\n", filled(&parts)) };
            self.body.section("Not needed, on purpose.");
            self.body.line(format!("wire unused = &{{{list}}};"), "");
        }
    }
}
