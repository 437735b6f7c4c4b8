//! The part of `tb.v` that is the design: our own with the unit's ports, or a user's with ports of other names.

use crate::dut::{Compare, Ends, Wire, Wiring};
use edgewalk_lockstep::{Direction, Interface, Link, Memory, Port};
use std::fmt::Write as _;

/// What the bench writes for a design.
pub struct Device {
    /// Name of the design's module.
    pub module: String,
    /// The reset that the bench gives: text of the clocks, bits of their counter.
    pub resets: (String, u32),
    /// Only order and values count.
    pub order_only: bool,
    /// The instance, with the wires it needs.
    pub instance: String,
    /// Ports and their bits.
    pub ports: Vec<(String, u32)>,
    /// Status ports and theirs.
    pub status: Vec<(String, u32)>,
    /// Counts of faults beside those of the channels.
    pub wrong: Vec<String>,
}

/// Our own design.
#[must_use]
pub fn reference(interface: &Interface) -> Device {
    let mut ports = vec!["clk(clk)".to_owned(), "rst(rst)".to_owned()];
    let mut widths: Vec<(String, u32)> = Vec::new();
    let of = |port: &Port| (port.name.clone(), port.width());
    for link in &interface.links {
        for end in ["valid", "ready"].map(|end| format!("{}_{end}", link.name)) {
            ports.push(format!("{end}({end})"));
            widths.push((end, 1));
        }
        ports.extend(places(link).map(|(field, bits)| format!("{}({bits})", field.name)));
        widths.extend(link.fields.iter().map(of));
    }
    let constant = |field: &Port| format!("{}({})", field.name, field.name.to_uppercase());
    ports.extend(interface.constants.iter().map(constant));
    ports.extend(interface.levels.iter().map(|field| format!("{0}({0})", field.name)));
    widths.extend(interface.constants.iter().chain(&interface.levels).map(of));
    let status: Vec<String> =
        interface.status.iter().map(|status| format!("{0}({0})", status.port.name)).collect();
    let module = interface.unit.module();
    Device {
        instance: instance(&module, "", &ports, &status),
        module,
        resets: ("3".to_owned(), 2),
        order_only: false,
        ports: widths,
        status: interface.status.iter().map(|status| of(&status.port)).collect(),
        wrong: Vec::new(),
    }
}

fn instance(module: &str, parameters: &str, ports: &[String], status: &[String]) -> String {
    let list: Vec<String> = ports.iter().map(|port| format!("        .{port}")).collect();
    let status: Vec<String> = status.iter().map(|port| format!(",\n        .{port}")).collect();
    let status = match status.is_empty() {
        true => String::new(),
        false => format!("`ifndef ORDER_ONLY\n        {}\n`endif\n", status.concat().trim_start()),
    };
    let list = list.join(",\n");
    format!("\n    // The design.\n    {module} {parameters}dut (\n{list}\n{status}    );\n")
}

/// The fields of a link, each with its bits of the packed token.
pub fn places(link: &Link) -> impl Iterator<Item = (&Port, String)> {
    let mut high = link.width();
    link.fields.iter().map(move |field| {
        let bits = format!("{}_token[{}:{}]", link.name, high - 1, high - field.width());
        high -= field.width();
        (field, bits)
    })
}

/// A user's design.
#[must_use]
pub fn own(interface: &Interface, wiring: &Wiring) -> Device {
    let dut = &wiring.dut;
    let mut text = String::new();
    let cycles = dut.reset.cycles;
    let level = if dut.reset.active_low { "!" } else { "" };
    if dut.reset.asynchronous {
        text += "\n    // An asynchronous reset ends between two edges of the clock.\n";
        text += "    reg dut_held = 1'b1;\n    always @(negedge clk) dut_held <= rst;\n";
    }
    let held = if dut.reset.asynchronous { "dut_held" } else { "rst" };
    let mut own = Own {
        text,
        ports: vec![format!("{}(clk)", dut.clock), format!("{}({level}{held})", dut.reset.port)],
        widths: Vec::new(),
        beyond: Vec::new(),
    };
    let mut wrong = Vec::new();
    for (link, ends) in interface.links.iter().zip(&wiring.links) {
        own.link(link, ends);
        if link.direction == Direction::Out {
            wrong.push(format!("{}_unheld", link.name));
        }
    }
    for (port, wire) in interface.constants.iter().zip(&wiring.constants) {
        own.input(port, wire, &port.name.to_uppercase());
    }
    for (port, wire) in interface.levels.iter().zip(&wiring.levels) {
        own.input(port, wire, &port.name);
    }
    for memory in &interface.memories {
        if let Some(path) = dut.memories.get(memory.name) {
            own.text += &filled(memory, path);
        }
    }
    own.ports.extend(dut.tie.iter().map(|(name, value)| format!("{name}({value})")));
    let connected = own.ports.len();
    let mut status_widths = Vec::new();
    for (status, wire) in interface.status.iter().zip(&wiring.status) {
        if let Wire::Port { name, .. } = wire {
            own.ports.push(format!("{name}({})", status.port.name));
            status_widths.push((name.clone(), status.port.width()));
        }
    }
    let status = own.ports.split_off(connected);
    let parameters: Vec<String> =
        dut.parameters.iter().map(|(name, value)| format!(".{name}({value})")).collect();
    let parameters =
        if parameters.is_empty() { String::new() } else { format!("#({}) ", parameters.join(", ")) };
    Device {
        module: dut.top.clone(),
        resets: (cycles.to_string(), u32::BITS - cycles.leading_zeros()),
        order_only: dut.compare == Compare::Order,
        instance: own.text + &instance(&dut.top, &parameters, &own.ports, &status),
        ports: own.widths,
        status: status_widths,
        wrong,
    }
}

/// The first words of a memory inside the design, at the begin of each run. The design may fill it at time 0 too: the bench
/// comes later.
fn filled(memory: &Memory, path: &str) -> String {
    let start = if memory.write.is_none() { START } else { "" };
    FILL.replace("{start}", start)
        .replace("{last}", &((1u64 << memory.address_bits) - 1).to_string())
        .replace("{path}", path)
        .replace("{memory}", memory.name)
        .replace("{MEMORY}", &memory.name.to_uppercase())
}

const FILL: &str = r#"
    // The memory {memory} is inside the design.
    integer {memory}_word;
    always @(negedge rst) begin
        #1;
        for ({memory}_word = 0; {memory}_word <= {last}; {memory}_word = {memory}_word + 1)
            dut.{path}[{memory}_word] = {MEMORY}_CLEAR;
{start}    end
"#;

const START: &str = r#"        if ({MEMORY}_START > 0) $readmemh("{memory}.start.mem", dut.{path}, 0, {MEMORY}_START - 1);
"#;

/// The instance of a user's design as it grows.
struct Own {
    text: String,
    ports: Vec<String>,
    widths: Vec<(String, u32)>,
    /// Conditions under which a port holds more than its value.
    beyond: Vec<String>,
}

impl Own {
    fn link(&mut self, link: &Link, ends: &Ends) {
        let name = link.name;
        match (&ends.valid, link.direction) {
            (Some(valid), _) => self.connect(valid, 1, &format!("{name}_valid")),
            (None, Direction::Out) => {
                let _ =
                    writeln!(self.text, "    assign {name}_valid = 1'b0; // its memory is inside the design");
            }
            (None, Direction::In) => {}
        }
        match (&ends.ready, link.direction) {
            (Some(ready), _) => self.connect(ready, 1, &format!("{name}_ready")),
            (None, Direction::In) => {
                let _ = writeln!(
                    self.text,
                    "    assign {name}_ready = 1'b1; // the design takes every token at once"
                );
            }
            (None, Direction::Out) => {}
        }
        let places: Vec<(&Port, String)> = places(link).collect();
        for ((port, bits), wire) in places.iter().zip(&ends.fields) {
            match link.direction {
                Direction::In => self.input(port, wire, bits),
                Direction::Out => {
                    let wanted = bits.replacen("_token", "_want", 1);
                    self.output(port, wire, bits, &wanted);
                }
            }
        }
        if let Some(packed) = &ends.packed {
            let parts: Vec<&str> = packed.order.iter().map(|place| places[*place].1.as_str()).collect();
            let width =
                packed.order.iter().map(|place| link.fields[*place].width()).sum::<u32>() + packed.above;
            let parts = parts.join(", ");
            match (link.direction, packed.above) {
                (_, 0) => self.connect(&packed.name, width, &format!("{{{parts}}}")),
                (Direction::In, above) => {
                    self.connect(&packed.name, width, &format!("{{{above}'b0, {parts}}}"));
                }
                (Direction::Out, above) => {
                    let wire = format!("dut_{}", packed.name);
                    let low = width - above;
                    let _ = writeln!(self.text, "    wire [{}:0] {wire};", width - 1);
                    let _ = writeln!(self.text, "    assign {{{parts}}} = {wire}[{}:0];", low - 1);
                    self.beyond.push(format!("{wire}[{}:{low}] !== {above}'b0", width - 1));
                    self.connect(&packed.name, width, &wire);
                }
            }
        }
        if link.direction == Direction::Out {
            let beyond = std::mem::take(&mut self.beyond);
            let beyond = if beyond.is_empty() { "1'b0".to_owned() } else { beyond.join(" || ") };
            self.text += &HOLD
                .replace("{name}", name)
                .replace("{NAME}", &name.to_uppercase())
                .replace("{beyond}", &beyond);
        }
    }

    fn connect(&mut self, port: &str, width: u32, expression: &str) {
        self.ports.push(format!("{port}({expression})"));
        self.widths.push((port.to_owned(), width));
    }

    /// A value that the bench gives.
    fn input(&mut self, port: &Port, wire: &Wire, value: &str) {
        let Wire::Port { name, above } = wire else { return };
        let (top, width) = (port.width() - 1, port.width() + above);
        let value = match above {
            0 => value.to_owned(),
            above if port.is_signed() => {
                // The highest bit of the part: `x_token[9:4]` has `x_token[9]`.
                let sign = value
                    .split_once(':')
                    .map_or_else(|| format!("{value}[{top}]"), |(high, _)| format!("{high}]"));
                format!("{{{{{above}{{{sign}}}}}, {value}}}")
            }
            above => format!("{{{above}'b0, {value}}}"),
        };
        self.connect(name, width, &value);
    }

    /// A value that the design gives; `wanted` is what it counts as where the design has no port for it.
    fn output(&mut self, port: &Port, wire: &Wire, value: &str, wanted: &str) {
        match wire {
            Wire::Packed => {}
            Wire::Absent => {
                let _ = writeln!(self.text, "    assign {value} = {wanted}; // not compared");
            }
            Wire::Port { name, above: 0 } => self.connect(name, port.width(), value),
            Wire::Port { name, above } => {
                let (low, width, wire) = (port.width(), port.width() + above, format!("dut_{name}"));
                let sign = if port.is_signed() { format!("{wire}[{}]", low - 1) } else { "1'b0".to_owned() };
                let _ = writeln!(self.text, "    wire [{}:0] {wire};", width - 1);
                let _ = writeln!(self.text, "    assign {value} = {wire}[{}:0];", low - 1);
                self.beyond.push(format!("{wire}[{}:{low}] !== {{{above}{{{sign}}}}}", width - 1));
                self.connect(name, width, &wire);
            }
        }
    }
}

const HOLD: &str = r#"    wire [31:0] {name}_unheld;
    bench_hold #(.WIDTH({NAME}_WIDTH), .NAME("{name}")) {name}_hold (
        .clk(clk), .rst(rst), .told(compared), .cycle(cycle),
        .valid({name}_valid), .ready({name}_ready), .data({name}_token),
        .beyond({beyond}), .wrong({name}_unheld)
    );
"#;
