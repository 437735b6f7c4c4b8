//! MACHINE: all units, joined as `docs/machine.md` has them.

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_netlist::{BuildErrors, Instance, Module, Netlist, Signal};

use crate::token::{self, Field, Token};
use crate::{depth, edge, pixel, setup, span};

const DOC: &str = "EDGEWALK draws triangles, scan line by scan line.

 tri ─> SETUP ─prim─> EDGE ─line─> SPAN ─span─> PIXEL ─frag─> DEPTH ─wr─> frame memory
                        └────────── gradients ───┘              └─rd / data─ depth memory

Every arrow but the gradients is a valid/ready channel: a token moves in a cycle where both are high.
valid never waits for ready. One clock, synchronous reset rst, active high.
activity is the one cause of the cycle: 1 draw, 2 off the screen, and stalls: 3 hazard, 4 queue full, 5 memory,
6 edge, 7 setup, 8 flush, 0 idle.";

/// The netlist of the whole machine.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn machine(machine: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk", DOC);
    let tri_valid = m.input("tri_valid", 1);
    let triangle = Token::inputs(&m, "tri", token::triangle(machine));
    let depth_func = m.input_doc("depth_func", 3, "new ? old");
    let depth_write = m.input_doc("depth_write", 1, "depths of passing fragments are written");
    let rd_ready = m.input("rd_ready", 1);
    let data_valid = m.input("data_valid", 1);
    let data_z = m.input_doc("data_z", machine.z.bits, "old depth");
    let wr_ready = m.input("wr_ready", 1);

    let u_setup = m.instance("u_setup", &setup(machine)?).connect("tri_valid", tri_valid);
    triangle.connect(u_setup, "tri");
    let u_edge = m.instance("u_edge", &edge(machine)?);
    join(u_setup, u_edge, "prim", token::prim(machine));
    let u_span = m.instance("u_span", &span(machine)?);
    join(u_edge, u_span, "line", token::line(machine));
    u_edge.connect("fresh_queued", u_span.output("fresh_queued"));
    let u_pixel = m.instance("u_pixel", &pixel(machine)?);
    join(u_span, u_pixel, "span", token::span(machine));
    Token::of_instance(u_edge, "inc", token::values(machine).collect()).connect(u_pixel, "inc");
    let u_depth = m
        .instance("u_depth", &depth(machine)?)
        .connect("depth_func", depth_func)
        .connect("depth_write", depth_write)
        .connect("rd_ready", rd_ready)
        .connect("data_valid", data_valid)
        .connect("data_z", data_z)
        .connect("wr_ready", wr_ready);
    join(u_pixel, u_depth, "frag", token::fragment(machine));

    m.comment("The cause of the cycle.");
    let activity = activity(&m, [u_setup, u_edge, u_span, u_pixel, u_depth]).named("activity");

    m.output("tri_ready", u_setup.output("tri_ready"));
    for port in ["rd_valid", "rd_addr", "data_ready", "wr_valid"] {
        m.output(port, u_depth.output(port));
    }
    Token::of_instance(u_depth, "wr", token::write(machine)).output(&m, "wr");
    m.output_doc("activity", activity, "the cause of the cycle");
    m.output_doc("idle", activity.eq(0), "nothing to do");
    m.finish()
}

/// A channel from one unit to the next.
fn join<'m>(from: Instance<'m>, to: Instance<'m>, channel: &str, fields: Vec<Field>) {
    let (valid, ready) = (format!("{channel}_valid"), format!("{channel}_ready"));
    to.connect(&valid, from.output(&valid));
    from.connect(&ready, to.output(&ready));
    Token::of_instance(from, channel, fields).connect(to, channel);
}

/// The first cause that holds.
fn activity<'m>(m: &'m Module, [setup, edge, span, pixel, depth]: [Instance<'m>; 5]) -> Signal<'m> {
    let cause = |name, value| m.constant(name, 4, value);
    let (draw, offscreen) = (cause("DRAW", 1), cause("OFFSCREEN", 2));
    let (hazard, queue, memory) = (cause("HAZARD", 3), cause("QUEUE", 4), cause("MEMORY", 5));
    let (edges, setting_up) = (cause("EDGE", 6), cause("SETUP", 7));
    let (flush, idle) = (cause("FLUSH", 8), cause("IDLE", 0));
    let advance = pixel.output("advance");
    let in_flight = pixel.output("occupied") | depth.output("occupied");
    let waits = depth.output("hazard").mux(hazard, depth.output("full").mux(queue, memory));
    let lower = in_flight.mux(flush, idle);
    let lower = (!setup.output("tri_ready")).mux(setting_up, lower);
    let lower = (span.output("span_valid") | edge.output("line_valid")).mux(edges, lower);
    let draws = pixel.output("visible").mux(draw, offscreen);
    advance.mux(pixel.output("active").mux(draws, lower), waits)
}
