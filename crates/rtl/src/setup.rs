//! SETUP: from three vertices to edges and increments.

mod schedule;

mod control;

mod sort;

mod lines;

mod operands;

mod lane;

mod lanes;

mod results;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{setup::SPEC, tokens::EDGES};
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::ports::Interface;
use crate::wires::{Registers, parts};
use control::Control;
use lines::Lines;
use operands::Sources;
use results::{Area, Results};
use sort::Vertices;

const DOC: &str = "SETUP turns three vertices into edges and increments.

  tri ─> [sort by v] ─┬─> lines j0 j1 n1 n2 ────────────────────────────┐
                      ├─> area ─> major_right, cull?                    ├─> prim
                      ├─> three edges: q f = DX/DY, C R = N/DY ─────────┤
                      └─> N channels: increments and start ─────────────┘
            the products and quotients are formed in serial lanes, side by side or in rounds

Formats: see the ports; P = 2^t is a pixel in centre coordinates.
Timing: three clocks to sort, then for each round of the lanes three operations on edges; if the triangle draws
anything, for each round the operations on channels, and one clock to store. prim_valid is high from the next on.
Rules: all results are those of exact division, rounded once; a word keeps its low bits.";

/// The netlist of SETUP.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn setup(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_setup", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (tri_valid, triangle) = ports.takes();
    let prim_ready = ports.gives_ready();

    let control = Control::new(&m, plan, tri_valid, prim_ready);
    let vertices = Vertices::new(&m, plan, &control, &triangle);

    // The first line and the moduli follow from other registers; all else of the prim is a register.
    let computed = |name: &str| name == "jm" || name.ends_with("_m");
    let mut kept = parts(&ports.gives_link().fields);
    kept.retain(|f| !computed(&f.name));
    let prim = Registers::new(&m, "prim", kept);
    if let Some(tag) = triangle.get("tag") {
        prim["tag"].when(control.take, tag);
    }
    let lines = Lines::new(&m, plan, &control, &vertices, &prim);

    let lanes = lanes::lanes(&m, plan, &control)?;
    let area = Area::new(&m, plan, &control, lanes[0].instance, &prim);
    control.cull.drive(area.is_zero() | lines.none);
    let sources = Sources {
        m: &m,
        plan,
        control: &control,
        vertices: &vertices,
        lines: &lines,
        prim: &prim,
        area: area.value(),
    };
    let shared = sources.shared();
    for (i, lane) in lanes.iter().enumerate() {
        m.comment(&format!("Lane {i}."));
        sources.connect(lane, &shared);
    }
    let lanes: Vec<_> = lanes.iter().map(|lane| lane.instance).collect();
    Results { m: &m, plan, control: &control, vertices: &vertices, prim: &prim }.take(&lanes);

    ports.take_ready(control.idle);
    let heights = EDGES.iter().zip(&vertices.heights);
    let moduli: Vec<_> = heights.map(|(edge, height)| (format!("{edge}_m"), *height)).collect();
    let first_line = lines.jm.trunc(plan.widths().y);
    ports.give(control.done, |name| match moduli.iter().find(|(modulus, _)| modulus == name) {
        Some((_, height)) => *height,
        None if name == "jm" => first_line,
        None => prim[name].q(),
    });
    m.finish()
}
