//! SETUP as a program: words in a ROM, lanes that do one addition a clock.

mod code;
mod shape;
mod lane;
mod words;
mod digits;
mod rows;
mod control;
mod results;

use std::sync::Arc;

use edgewalk_machine::Plan;
use edgewalk_machine::sequencer::{Program, edges_are_beside};
use edgewalk_machine::units::setup::SPEC;
use edgewalk_netlist::{BuildErrors, Instance, Module, Netlist, Reg, Signal};

use crate::light_pass::LightPass;
use crate::ports::Interface;
use code::Decoded;
pub use code::{RomWord, program_rom};
use control::Control;
use digits::Digits;

const DOC: &str = "SETUP turns three vertices, which come word by word, into edges and increments. It is a program.

  words ─> rows of the lanes ─> [A, W] ─> rows, prim
  ROM ─> word: which row, which step, which result, which word comes next
  [f, g] ─> digits: which row of a table is added

Formats: see the ports; in centre coordinates pixel centres lie on whole numbers.
Timing: a word names a row in its first clock, does its step in the second; in the third A and W are written, and leave.
Rules: docs/machine.md, section 2, prints the program and says what each clause of a word does. A name of a code is the
part of the word and the clause: ACT_SIDE is `side`, JUMP_NEGATIVE is `negative l`, GIVE_QF is `give qf`.";

/// The parts that the files of this unit share.
struct Parts<'a, 'm> {
    m: &'m Module,
    plan: &'a Plan,
    program: &'a Program,
    lanes: Vec<Instance<'m>>,
    /// The word that is executed.
    word: Decoded<'m>,
    /// Thin and flat of the triangle or line that is worked on, in a machine that takes lines.
    role: Option<[Reg<'m>; 2]>,
    /// The word is valid: the ROM has been read since the reset.
    runs: Signal<'m>,
}

impl<'m> Parts<'_, 'm> {
    /// A lane's output.
    fn of_lane(&self, lane: usize, port: &str) -> Signal<'m> {
        self.lanes[lane].output(port)
    }

    /// A lane whose edge, with the edges side by side, is one of its own.
    fn has_own_edge(&self, lane: usize) -> bool {
        edges_are_beside(self.plan) && lane < 3
    }

    /// The signal a clock later.
    fn later(&self, name: &str, signal: Signal<'m>) -> Signal<'m> {
        self.m.reg(name, signal.width()).set(signal).q()
    }
}

/// The netlist of a sequenced SETUP.
///
/// # Errors
/// None for a machine that [`edgewalk_machine::Machine::plan`] accepts.
pub(super) fn setup(plan: &Plan) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new("edgewalk_setup", DOC);
    let ports = Interface::new(&m, (SPEC.ports)(plan));
    let (in_valid, triangle) = ports.takes();
    let prim_ready = ports.gives_ready();
    let light_pass = LightPass::of(plan, &ports);
    let program = &Program::of(plan);

    m.comment("The program.");
    let next = m.wire("next_place", code::place_bits(program));
    let word = code::rom(&m, program, next.q());
    let runs = m.reg("runs", 1).doc("the first word is there").reset(0).starts_at_zero();
    let runs = runs.set(1).q();
    let lanes = lanes(&m, plan, program)?;
    let role = plan.polygon.has_lines().then(|| {
        let taken = |name: &str, doc: &str| m.reg(&format!("taken_{name}"), 1).doc(doc);
        [taken("thin", "a line is worked on"), taken("flat", "one with x and y exchanged")]
    });
    let parts = Parts { m: &m, plan, program, lanes, word, role, runs };

    let digits = Digits::new(&parts);
    let control = Control::new(&parts, &digits, prim_ready);
    next.drive(control.next);
    let input = words::words(&parts, &control, in_valid, triangle["data"]);
    rows::connect(&parts, &control, &digits, &input, light_pass);
    let prim = results::results(&parts, &control, &ports.gives_link().fields);
    for (name, value) in [("kt", input.kt), ("tag", triangle.get("tag"))] {
        if let (Some(register), Some(value)) = (prim.get(name), value) {
            let taken = m
                .reg(&format!("taken_{name}"), register.q().width())
                .doc("of the triangle that is worked on");
            taken.when(input.last, value.trunc(register.q().width()));
            register.when(control.done, taken.q());
        }
    }
    if let Some([thin, flat]) = parts.role {
        thin.when(input.last, triangle["thin"]);
        flat.when(input.last, triangle["thin"] & triangle["flat"]);
        prim["thin"].when(control.done, thin.q());
        prim["flat"].when(control.done, flat.q());
    }
    if let Some(record) = prim.get("record") {
        let bits = plan.shade.record_bits;
        let taken = m.reg("taken_record", bits).doc("number of the triangle that is worked on");
        // Culled triangles count: the first after a reset has record 0.
        taken.reset((1 << bits) - 1).when(input.last, taken.q() + 1);
        record.when(control.done, taken.q());
    }

    ports.take_ready(control.idle);
    ports.give(control.prim_there, |name| prim[name].q());
    m.finish()
}

/// The lanes, of one module where they are alike.
fn lanes<'m>(m: &'m Module, plan: &Plan, program: &Program) -> Result<Vec<Instance<'m>>, BuildErrors> {
    let mut made: Vec<(lane::Shape, Arc<Netlist>)> = Vec::new();
    let mut lanes = Vec::new();
    for number in 0..plan.lanes as usize {
        let shape = shape::shape(plan, program, number);
        let known = made.iter().find(|(other, _)| other.is_like(&shape)).map(|(_, netlist)| netlist.clone());
        let netlist = match known {
            Some(netlist) => netlist,
            None => {
                let netlist = lane::lane(&format!("edgewalk_setup_lane{number}"), &shape)?;
                made.push((shape, netlist.clone()));
                netlist
            }
        };
        lanes.push(m.instance(&format!("lane{number}"), &netlist));
    }
    Ok(lanes)
}
