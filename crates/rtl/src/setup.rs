//! SETUP: from three vertices to edges and increments.

mod steps;
mod control;
mod sort;
mod role;
mod polygon;
mod along;
mod walked;
mod top;
mod lines;
mod area;
mod scale;
mod factors;
mod lane;
mod lanes;
mod values;
mod operands;
mod results;

mod sequencer;

pub use sequencer::{RomWord, program_rom};

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{setup::SPEC, tokens::EDGES};
use edgewalk_netlist::{BuildErrors, Module, Netlist};

use crate::light_pass::LightPass;
use crate::ports::Interface;
use crate::wires::{Registers, parts};
use area::Area;
use control::{Control, Handshakes};
use lines::Lines;
use results::Results;
use scale::Scale;
use sort::Vertices;

const DOC: &str = "SETUP turns three vertices into edges and increments.

  tri ─> [sorted by v] ─┬─> lines j0 j1 n1 n2, columns ─> none? culled
                        ├─> area ─> major_right; 0? culled; fourfold till values fit: M
                        └─> differences ─> lanes ─┬─> three edges: q f, C R ──────────────┬─> prim
                                                  └─> N channels: g, d0, d1, start ───────┘
            a lane holds a pair, whole + rest / M: quotient and exact remainder, doubled and added to

Formats: see the ports; in centre coordinates pixel centres lie on whole numbers.
Timing: the edges, then the channels, as many side by side as there are lanes. How long they take follows the triangle: a sum
takes a clock for a bit of its factors. prim_valid is high four clocks after the last operation.
Rules: all results are those of exact division, rounded once; a word keeps its low bits.";

/// The netlist of SETUP.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub fn setup(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    if plan.is_sequenced() {
        return sequencer::setup(plan);
    }
    let m = Module::new("edgewalk_setup", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (tri_valid, triangle) = ports.takes();
    let prim_ready = ports.gives_ready();
    let light_pass = LightPass::of(plan, &ports);

    let control = Control::new(&m, plan, &Handshakes { tri_valid, prim_ready });
    let vertices = Vertices::new(&m, plan, &control, &triangle);

    // The first line, the moduli and the side follow from other registers; all else of the prim is a
    // register.
    let along = along::Along::new(plan);
    let computed = |name: &str| matches!(name, "jm" | "major_right" | "void") || name.ends_with("_m");
    let mut kept = parts(&ports.gives_link().fields);
    kept.retain(|f| !computed(&f.name) && !along.has(&f.name));
    let prim = Registers::new(&m, "prim", kept);
    for name in ["kt", "tag"] {
        if let (Some(register), Some(value)) = (prim.get(name), triangle.get(name)) {
            register.when(control.sequence.take, value);
        }
    }
    let role = role::Role::take(&control, &triangle, &prim);
    if let Some(record) = prim.get("record") {
        // Culled triangles count: the first after a reset has record 0.
        let ends = triangle.get("kind").map(|kind| kind.ne(polygon::Kind::Edges as i32));
        let counts = ends.map_or(control.sequence.take, |ends| control.sequence.take & ends);
        record.reset((1 << plan.shade.record_bits) - 1).when(counts, record.q() + 1);
    }
    let polygon = polygon::Polygon::take(&m, plan, &control, light_pass, &triangle, &prim, &vertices.order);
    let walked = walked::Walked::new(&prim);
    let area = Area::new(&m, plan, &control, &vertices);
    let scale = Scale::new(&m, plan, &control, &area);
    let screen = lines::Screen { m: &m, plan, light_pass, role, polygon };
    let lines = Lines::new(&screen, &control, &vertices, &prim, &area);
    let sources = factors::Sources {
        m: &m,
        plan,
        control: &control,
        vertices: &vertices,
        lines: &lines,
        area: &area,
        prim: &prim,
        walked: &walked,
    };
    let factors = sources.factors();

    let lanes = lanes::lanes(&m, plan, &control, &factors, area.negative)?;
    let values = values::Values::new(&m, plan, &control, &vertices, &area);
    let sources = operands::Sources {
        m: &m,
        plan,
        control: &control,
        vertices: &vertices,
        area: &area,
        scale: &scale,
        walked: &walked,
        values: &values,
    };
    let differences: Vec<_> = lanes.iter().map(|lane| sources.connect(lane)).collect();
    scale.gather(plan, &control, &differences);
    let unfit = lanes.iter().filter_map(|lane| sources.unfit(lane));
    control.feedback.unfit.drive(unfit.reduce(|any, one| any | one).unwrap_or(m.lit(1, 0)));
    Results { m: &m, plan, control: &control, vertices: &vertices, prim: &prim, walked: &walked }
        .take(&lanes);

    ports.take_ready(control.sequence.idle);
    let heights = EDGES.iter().zip(&vertices.heights);
    let moduli: Vec<_> = heights.map(|(edge, height)| (format!("{edge}_m"), *height)).collect();
    let void = || polygon.map_or(m.lit(1, 0), |polygon| polygon.plane & control.feedback.no_area.q());
    let first_line = lines.jm.trunc(plan.widths().line);
    ports.give(control.sequence.done, |name| match moduli.iter().find(|(modulus, _)| modulus == name) {
        Some((_, height)) => *height,
        None if name == "jm" => first_line,
        None if name == "major_right" => area.negative,
        None if name == "void" => void(),
        None if along.has(name) => along.field(name, &vertices, &lines),
        None => prim[name].q(),
    });
    m.finish()
}
