//! LAMP: finds the cosines of a light at a point, and how much of it comes.

mod beside;
mod made;
mod multiply;
mod operands;
mod root;
mod turns;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::lamp::SPEC;
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use crate::ports::Interface;
use crate::roots::Roots;
use beside::Beside;
use made::Results;
use multiply::Multiplier;
use operands::Operands;
use root::Root;
use turns::{Links, Turns};

const DOC: &str = "LAMP finds the cosines of a light at a point, and the share of its light that arrives.

  frag ─> [there] <─> [here] ─> root of dd, of nn, of 1 + L.V ─> [k, m] ─> tables ─> [a] * [b] ─> [results] ─> normed
                                          roots memory ─ rdata ─┘

Formats: dd is signed, 2^30 for 1.0; pl, dv, da, pv are signed, 2^23 for 1.0; nn and cosines are signed, 2^16 for 1.0.
Attenuation and beam: 2^16 for 1.0. Tables hold {v, slope}: R 1/sqrt(k/256), C the beam beside the axis, A the attenuation.
slope is the decrease to the next entry.
Timing: two fragments in turn, a step of each in two clocks: 34 for both. The fragment in here does the first half of
its step, the fragment in there the second half. The operands of step s are multiplied in step s + 1.
  step   1    2    3    4    5    6    7    8    9    10   11   12   13   14   15   16
  root   dd                       nn                       LV
  table       R    A                   R         C              R
  a * b       y    att  pl   dv   da   y         cone L    pv   y    beam H    nl
Rules: the tables are fetched once after a reset, when the first fragment is offered, a word a clock. No fragment is taken
before.";

/// The netlist of LAMP.
///
/// # Errors
/// None for a machine with LAMP that [`edgewalk_machine::Machine::plan`] accepts.
pub fn lamp(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_lamp", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let memory = ports.memory("roots");
    let normed_ready = ports.gives_ready();
    let roots = Roots::new(&m, plan, "tables R, C, A", frag_valid, &memory);

    let turns = Turns::new(&m, &frag, roots.have, &Links { frag_valid, normed_ready });
    let results = Results::new(&m, &turns);
    let root = Root::new(&m, &turns, &results);
    let beside = Beside::new(&m, &roots, memory.data["word"], &turns, &results);
    let operands = Operands { m: &m, turns: &turns, results: &results, root: &root, beside: &beside };
    let product = Multiplier::new(&m, &turns, &operands.choose(&roots));
    results.update(&turns, &product, beside.dark);
    let indices = made::indices(&m, plan, &turns, &product);

    ports.take_ready(turns.frag_ready);
    ports.read("roots", roots.read_valid, roots.read_place, roots.loading);
    ports.give(turns.normed_valid, |f| match indices.iter().find(|(name, _)| name == f) {
        Some((_, index)) => *index,
        None if f == "beam" => results.beam.here(),
        None => turns.of(f),
    });
    ports.status("table_wait", frag_valid & !roots.have);
    ports.status("working", turns.working);
    ports.status("occupied", turns.occupied);
    m.finish()
}

/// The number times 2^count, of so many bits more.
fn zeros_behind(number: Signal<'_>, count: u32) -> Signal<'_> {
    let m = number.module();
    m.cat(&[number, m.lit(count, 0)])
}
