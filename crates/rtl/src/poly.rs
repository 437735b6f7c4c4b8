//! POLY: walks all edges of a polygon, a pair of them a span.

mod table;
mod along;
mod load;
mod pass;
mod insert;
mod columns;
mod between;
mod mover;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::poly::SPEC;
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::light_pass::LightPass;
use crate::ports::Interface;
use load::Load;
use mover::Mover;
use pass::Pass;
use table::Tables;

const DOC: &str = "POLY walks all edges of a polygon from line to line, a pair of them a span.

  prim ─> LOAD ─> [edge table] ──────> PASS ─pair─> MOVER ─> line
            └──> [order list] ───────> │ ^            └────> inc, held for PIXEL
                 [active list of y] ─> B C D E ─> [active list of y + 1]

LOAD writes the edges of a polygon to one half of the table, and their numbers to the order list, by their first lines.
PASS goes through the active list of a line: each pair of columns is a span, each edge steps to the next line and goes
into its list, by its column. MOVER takes the values along, by d0 from line to line, by g from column to column.

Timing: a line of n edges takes n + 2 clocks, an edge that enters 1 more, one that goes before m others m + 2 more.
MOVER takes a clock a line down, one for each bit of the number of columns, and one more.
Rules: a step takes f from R; where R is too small M is added back and the column goes one further (carry).
R - f is what is kept, so that its sign says whether the step carries.
A polygon of more edges than the table has places is refused: nothing of it is drawn.";

/// The netlist of POLY.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn poly(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_poly", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (prim_valid, prim) = ports.takes();
    let line_ready = ports.gives_ready();
    let fresh_queued = ports.level("fresh_queued");
    let light_pass = LightPass::of(plan, &ports);

    let walking = m.wire("walking", 1).doc("a polygon is walked, or its last span waits");
    let writes = m.wire("pass_writes", 1).doc("PASS writes a record");
    let tables = Tables::new(&m, plan, &prim);
    let links =
        load::Links { prim_valid, prim: &prim, fresh_queued, walking: walking.q(), pass_writes: writes.q() };
    let load = Load::new(&m, plan, &tables, &links);
    let pair_leaves = m.wire("pair_leaves", 1).doc("MOVER takes the pair that waits, or drops it");
    let links = pass::Links {
        load: &load,
        prim: &prim,
        walking: walking.q(),
        pair_leaves: pair_leaves.q(),
        light_pass,
    };
    let pass = Pass::new(&m, plan, &tables, &links);
    writes.drive(pass.writes);
    let links = mover::Links {
        prim: &prim,
        begins: load.begins,
        walking: walking.q(),
        pair: pass.pair,
        line_ready,
        fresh_queued,
    };
    let mover = Mover::new(&m, plan, &links);
    pair_leaves.drive(mover.pair_leaves);
    walking.drive(pass.run | pass.pair.waits | mover.has_span);

    ports.take_ready(load.prim_ready);
    ports.give(mover.line_valid, |f| mover.line(f));
    ports.hold("inc", |f| mover.increments[f].q());
    ports.status("walking", walking.q());
    ports.status("refused", load.refused);
    m.finish()
}
