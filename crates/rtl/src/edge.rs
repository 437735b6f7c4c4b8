//! EDGE: walks the two edges of a triangle, a line a step.

mod walk;
mod side;
mod values;

use std::sync::Arc;

use edgewalk_machine::units::{edge::SPEC, tokens};
use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::ports::Interface;
use crate::wires::{Registers, Token, parts};
use side::{major, minor};
use values::{Choices, values};
use walk::{Links, Walk};

const WALKS: &str = "EDGE walks the major and the minor edge of a triangle, a line a step.";

/// Behind a SETUP whose registers take the next triangle while EDGE walks this one.
const MOVING: &str = "  prim ─> [major C R-f q f M] ── cmaj ─────┐
          [minor C R-f q f M] ── cmin ─────┼─> line
          [a value a channel] ─ by carry ──┘
          [g of each channel] ───────────────> inc, held for PIXEL

Timing: the first line is valid in the cycle after the triangle was taken, then one line a clock while line_ready.";

/// Behind a SETUP whose registers keep the triangle while EDGE walks it.
const STAYING: &str = "  prim ─┬> [major C R-f] ──────── cmaj ─────┐
        ├> [minor C R-f q f M] ── cmin ─────┼─> line
        ├> [a value a channel] ─ by carry ──┘
        └─ g of each channel ─────────────────> inc, not held here

Timing: the first line is valid in the cycle after an idle EDGE sees prim_valid, then one line a clock while line_ready.
The triangle is taken behind its last line, when PIXEL has its increments. Until then prim stays, and EDGE reads it.";

const RULES: &str = "Rules: a step takes f from R; where R is too small M is added back and the column goes one further (carry).
R - f is what is kept, so that its sign says whether the step carries, and no step waits for a subtraction to know it.
The columns are not cut to the screen here: SPAN does that.";

fn doc(plan: &Plan) -> String {
    let walk = if plan.is_sequenced() { STAYING } else { MOVING };
    format!("{WALKS}\n\n{walk}\n{RULES}")
}

/// The netlist of EDGE.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn edge(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_edge", &doc(plan));
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (prim_valid, prim) = ports.takes();
    let line_ready = ports.gives_ready();
    let links = Links { prim_valid, line_ready, fresh_queued: ports.level("fresh_queued") };

    let walk = Walk::new(&m, plan, &links, &prim);
    let line = line(&m, plan, &walk, &prim);
    let (major, carry) = major(&m, &walk, &prim);
    let (minor, has_upper) = minor(&m, &walk, &prim);
    let increments = values(&m, plan, &walk, &prim, &line, &Choices { carry, has_upper });

    ports.take_ready(walk.prim_ready);
    ports.give(walk.running, |f| match f {
        "cmaj" => major,
        "cmin" => minor,
        // In exact fill only another triangle can hold the same pixel.
        "fence" => line.get("fence").unwrap_or(line["fresh"]).q(),
        own => line[own].q(),
    });
    ports.hold("inc", |f| increments[f]);
    m.finish()
}

/// The registers of the line that is offered; those of the channels have no updates yet.
fn line<'m>(m: &'m Module, plan: &Plan, walk: &Walk<'m>, prim: &Token<'m>) -> Registers<'m> {
    let elsewhere = match plan.fill {
        Fill::Exact => ["cmaj", "cmin", "fence"].as_slice(),
        Fill::Textbook => &["cmaj", "cmin"],
    };
    let mut own = parts(&tokens::line(plan));
    own.retain(|f| !elsewhere.contains(&f.name.as_str()));
    let line = Registers::new(m, "line", own);
    line["y"].when(walk.line_done, walk.idle.mux(prim["jm"], line["y"].q() + 1));
    line["major_right"].when(walk.offered, prim["major_right"]);
    for name in ["thin", "flat"] {
        if let (Some(register), Some(value)) = (line.get(name), prim.get(name)) {
            register.when(walk.offered, value);
        }
    }
    line["fresh"].when(walk.moves, walk.idle);
    if let Some(fence) = line.get("fence") {
        fence.when(walk.moves, walk.exchanges);
    }
    if let (Some(register), Some(tag)) = (line.get("tag"), prim.get("tag")) {
        register.when(walk.offered, tag);
    }
    line
}
