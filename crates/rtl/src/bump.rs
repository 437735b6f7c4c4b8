//! BUMP: turns the normal of a fragment by the slopes of a relief.

mod turn;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::units::{bump::SPEC, tokens};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use crate::ports::Interface;
use crate::wires::{Part, Registers, Token, parts};
use turn::Turn;

const DOC: &str = "BUMP turns the normal of a fragment by the slopes of a relief.

  frag ─> [K1: bu * u, bv * v of each cosine] ─> [K2: cosine + both] ─> bumped

Formats: bu and bv are signed, 2^(bits-1) for the relief's largest slope. Cosines and their u and v are signed, in one unit.
Sums are exact; a cosine saturates at the ends of its range.
Timing: a fragment a clock, offered two clocks after it was taken. All stages advance together.
Rules: fragments are independent of each other.";

const SQUARE_DOC: &str = "With NORMAL behind: K1 also makes bu * bu, bu * bv and bv * bv. K2 multiplies them by tuu, tuv and tvv. K3 adds nn and makes
N.N of the turned normal, 2^16 for 1.0. A fragment is offered three clocks after it was taken.";

/// N.N, and what it is when the normal has turned.
const SQUARE: &str = "nn";
const SQUARES: [&str; 3] = ["tuu", "tuv", "tvv"];

/// The netlist of BUMP.
///
/// # Errors
/// None for a machine with BUMP that [`edgewalk_machine::Machine::plan`] accepts.
pub fn bump(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_bump", DOC);
    let normalises = plan.shade.normalises();
    if normalises {
        m.doc(SQUARE_DOC);
    }
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (frag_valid, frag) = ports.takes();
    let bumped_ready = ports.gives_ready();

    m.comment("Stages, and the fields that pass through them unchanged.");
    let given = parts(&tokens::bumped(plan));
    let of_lights = &plan.terms()[..2 * plan.shade.lights as usize];
    let is_cosine = |part: &Part| of_lights.iter().any(|term| term.name == part.name);
    let (cosines, through): (Vec<Part>, Vec<Part>) = given.iter().cloned().partition(is_cosine);
    let squares = |part: &Part| SQUARES.contains(&part.name.as_str());
    let goes_in = |part: &Part| given.iter().any(|other| other.name == part.name) || squares(part);
    let mut lists = vec![frag.parts().into_iter().filter(goes_in).collect(), through.clone()];
    if normalises {
        lists.push(through.into_iter().filter(|part| part.name != SQUARE).collect());
    }
    let stages: Vec<Stage<'_>> =
        lists.into_iter().zip(["k1", "k2", "k3"]).map(|(kept, name)| Stage::new(&m, name, kept)).collect();
    let last = stages[stages.len() - 1].valid.q();
    let advance = (!last | bumped_ready).named_doc("advance", "all stages advance");
    let kept = fill(&stages, advance, frag_valid, &frag);
    let occupied = stages.iter().map(|stage| stage.valid.q()).reduce(|any, one| any | one).unwrap_or(last);

    let turn = Turn { m: &m, plan, advance, cosines: &cosines };
    let products = turn.products(&frag);
    let k1 = stages[0].kept.token();
    let mut sums = turn.sums(&k1, &products);
    let square = products.of_slopes.map(|of_slopes| {
        let growths = turn.growths(&k1, of_slopes);
        turn.square(&mut sums, stages[1].kept.token()[SQUARE], growths)
    });

    ports.take_ready(advance);
    ports.give(last, |f| match cosines.iter().position(|part| part.name == f) {
        Some(place) => sums[place],
        None => square.filter(|_| f == SQUARE).unwrap_or_else(|| kept[f]),
    });
    ports.status("occupied", occupied);
    m.finish()
}

/// What goes through a stage as it is.
struct Stage<'m> {
    valid: Reg<'m>,
    kept: Registers<'m>,
}

impl<'m> Stage<'m> {
    fn new(m: &'m Module, name: &str, kept: Vec<Part>) -> Stage<'m> {
        let valid = m.reg(&format!("{name}_valid"), 1).doc("the stage holds a fragment").reset(0);
        Stage { valid, kept: Registers::new(m, name, kept) }
    }
}

/// Moves fragments from stage to stage, and gives what the last one keeps.
fn fill<'m>(
    stages: &[Stage<'m>],
    advance: Signal<'m>,
    frag_valid: Signal<'m>,
    frag: &Token<'m>,
) -> Token<'m> {
    let (mut valid, mut before) = (frag_valid, frag.clone());
    for stage in stages {
        stage.valid.when(advance, valid);
        stage.kept.load(advance, |f| before[f]);
        (valid, before) = (stage.valid.q(), stage.kept.token());
    }
    before
}
