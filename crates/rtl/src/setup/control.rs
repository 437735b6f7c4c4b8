//! Control of SETUP: its states, the operation that begins in a clock, and the stages that an operation goes
//! through.

mod clocks;
mod codes;
mod feedback;
mod counters;
mod parts;
mod pause;
mod sequence;
mod length;
mod way;

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use clocks::longest;
use codes::Codes;
use counters::{Counters, States};
use feedback::Feedback;
use pause::Pause;
use sequence::Sequence;
use way::Way;

/// What SETUP does in a clock.
pub(super) struct Control<'m> {
    pub sequence: Sequence<'m>,
    pub way: Way<'m>,
    pub pause: Pause<'m>,
    pub feedback: Feedback<'m>,
    /// No operation is done: SETUP waits for the area, gives up, or is not at work.
    pub rests: Signal<'m>,
}

/// The handshakes of SETUP, as far as control reads them.
pub(super) struct Handshakes<'m> {
    /// A triangle is offered.
    pub tri_valid: Signal<'m>,
    /// The prim is accepted.
    pub prim_ready: Signal<'m>,
}

/// What the parts of control are built from.
struct Base<'a, 'm> {
    m: &'m Module,
    plan: &'a Plan,
    states: States<'m>,
    codes: Codes<'m>,
    feedback: Feedback<'m>,
    counters: Counters<'m>,
    pause: Pause<'m>,
}

impl<'m> Control<'m> {
    /// The registers and their updates.
    pub fn new(m: &'m Module, plan: &Plan, handshakes: &Handshakes<'m>) -> Control<'m> {
        m.comment("Control: the operations one after the other, a clock each or more; in rounds where there are more jobs than lanes.");
        let states = States::new(m);
        let codes = Codes::new(m, plan);
        // A sum has at most as many digits as a difference, without the sign.
        let left_bits = longest(plan).max(plan.widths().difference).ilog2() + 1;
        let feedback = Feedback::new(m, plan, left_bits);
        let counters = Counters::new(m, plan, codes.bits(), left_bits);
        let pause = Pause::new(m, plan);
        let base = Base { m, plan, states, codes, feedback, counters, pause };

        let sequence = Sequence::new(&base, handshakes);
        length::load(&base, &sequence);
        let way = Way::new(&base, &sequence);
        base.pause.update(&base, &sequence, &way);
        let rests = (!sequence.goes).named("rests");
        Control { sequence, way, pause: base.pause, feedback: base.feedback, rests }
    }
}
