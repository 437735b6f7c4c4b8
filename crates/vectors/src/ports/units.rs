//! The interface of every unit.

use super::{Channel, Direction, Field, Interface, Status, Unit, fields};
use edgewalk_machine::Plan;

/// The ports of a unit of this machine.
#[must_use]
pub fn interface(machine: &Plan, unit: Unit) -> Interface {
    let mut interface = Interface {
        unit,
        channels: Vec::new(),
        constants: Vec::new(),
        levels: Vec::new(),
        status: Vec::new(),
        memory: false,
    };
    let channels = &mut interface.channels;
    let tri = || into("tri", fields::triangle_fields(machine));
    match unit {
        Unit::Machine => {
            channels.push(tri());
            depth_memory(machine, &mut interface);
            interface.status = vec![
                status(bits(
                    "activity",
                    4,
                    "cause of the cycle: 0 idle 1 draw 2 offscreen 3 hazard 4 queue 5 memory 6 edge 7 setup 8 flush",
                )),
                status(bits("idle", 1, "activity is 0")),
            ];
        }
        Unit::Setup => {
            channels.push(tri());
            channels.push(out("prim", fields::prim_fields(machine)));
        }
        Unit::Edge => {
            let mut line = fields::line_fields(machine);
            line.extend(fields::gradient_fields(machine));
            channels.push(into("prim", fields::prim_fields(machine)));
            channels.push(out("line", line));
            interface.levels.push(bits("fresh_queued", 1, "PIXEL has not taken the gradients yet"));
        }
        Unit::Span => {
            // Whether a line is empty, and therefore taken, is asked of lines only.
            let line = into("line", fields::line_fields(machine));
            channels.push(Channel { ready_always: false, ..line });
            channels.push(out("span", fields::span_fields(machine)));
            interface.status =
                vec![status(bits("fresh_queued", 1, "the first span of a triangle is queued"))];
        }
        Unit::Pixel => {
            let mut span = fields::span_fields(machine);
            span.extend(fields::gradient_fields(machine));
            channels.push(into("span", span));
            channels.push(out("frag", fields::fragment_fields(machine)));
            interface.status = vec![
                status(bits("active", 1, "a span is being drawn")),
                Status { during: Some("active"), ..status(bits("visible", 1, "its pixel is on the screen")) },
                status(bits("advance", 1, "nothing waits at the output")),
                status(bits("occupied", 1, "a fragment is in an output stage")),
            ];
        }
        Unit::Depth => {
            // Whether a pixel is in flight is asked of fragments only.
            let frag = into("frag", fields::fragment_fields(machine));
            channels.push(Channel { ready_always: false, ..frag });
            depth_memory(machine, &mut interface);
            interface.status = vec![
                Status {
                    during: Some("frag_valid"),
                    ..status(bits("hazard", 1, "the fragment must wait for one in flight"))
                },
                status(bits("full", 1, "the in-flight queue is full")),
                status(bits("occupied", 1, "something is in flight")),
            ];
        }
    }
    interface
}

/// The channels of a unit that reads and writes depths.
fn depth_memory(machine: &Plan, interface: &mut Interface) {
    interface.channels.push(into("data", fields::data_fields(machine)));
    interface.channels.push(out("rd", fields::read_fields(machine)));
    interface.channels.push(out("wr", fields::write_fields(machine)));
    interface.memory = true;
    interface.constants = vec![
        bits("depth_func", 3, "0 never 1 less 2 equal 3 lequal 4 greater 5 notequal 6 gequal 7 always"),
        bits("depth_write", 1, "fragments that pass store their depth"),
    ];
}

fn into(name: &'static str, fields: Vec<Field>) -> Channel {
    Channel { name, direction: Direction::In, fields, ready_always: true }
}

fn out(name: &'static str, fields: Vec<Field>) -> Channel {
    Channel { name, direction: Direction::Out, fields, ready_always: true }
}

fn status(field: Field) -> Status {
    Status { field, during: None }
}

fn bits(port: &str, width: u32, format: &str) -> Field {
    Field { port: port.to_owned(), width, signed: false, format: format.to_owned() }
}
