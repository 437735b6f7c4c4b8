//! The two places of LAMP, each with the step and the fields of its fragment.

use edgewalk_netlist::{Module, Reg, Signal};

use crate::wires::{Registers, Token};

/// The step in which a fragment is done.
const LAST: i32 = 17;

/// The handshakes of LAMP, as far as the steps read them.
pub(super) struct Links<'m> {
    /// A fragment is offered.
    pub frag_valid: Signal<'m>,
    /// The fragment is accepted behind LAMP.
    pub normed_ready: Signal<'m>,
}

/// Two fragments in turn. The fragment in `here` does the first half of its step, the fragment in `there` the second half.
pub(super) struct Turns<'m> {
    /// The places change.
    pub turns: Signal<'m>,
    /// A fragment is inside.
    pub occupied: Signal<'m>,
    /// Fragments are inside, and none is offered.
    pub working: Signal<'m>,
    pub normed_valid: Signal<'m>,
    pub frag_ready: Signal<'m>,
    here_step: Reg<'m>,
    there_step: Reg<'m>,
    here: Registers<'m>,
}

impl<'m> Turns<'m> {
    /// The registers; `have`: the tables are there.
    pub fn new(m: &'m Module, frag: &Token<'m>, have: Signal<'m>, links: &Links<'m>) -> Turns<'m> {
        m.comment("Two places. Their fragments change places in each clock that no fragment is stalled in.");
        let busy = |name: &str| m.reg(name, 1).doc("the place holds a fragment").reset(0);
        let (here_busy, there_busy) = (busy("here_busy"), busy("there_busy"));
        let here_step = m.reg("here_step", 5).doc("step of the fragment, first half");
        let there_step = m.reg("there_step", 5).doc("step of the fragment, second half");
        let done = here_step.q().eq(LAST).named("done");
        let normed_valid = (here_busy.q() & done).named("normed_valid");
        let stalled = (normed_valid & !links.normed_ready).named("stalled");
        let occupied = (here_busy.q() | there_busy.q()).named("occupied");
        let frag_ready = (have & (!here_busy.q() | (normed_valid & links.normed_ready))).named("frag_ready");
        let take = (links.frag_valid & frag_ready).named("take");
        let turns = (!stalled & (occupied | (links.frag_valid & have))).named("turns");
        here_busy.when(turns, there_busy.q());
        there_busy.when(turns, take | (here_busy.q() & !done));
        here_step.when(turns, there_step.q() + 1);
        there_step.when(turns, take.mux(m.lit(5, 0), here_step.q()));
        let here = Registers::new(m, "here", frag.parts());
        let there = Registers::new(m, "there", frag.parts());
        here.load(turns, |f| there[f].q());
        there.load(turns, |f| take.mux(frag[f], here[f].q()));
        let working = (occupied & !normed_valid).named("working");
        Turns { turns, occupied, working, normed_valid, frag_ready, here_step, there_step, here }
    }

    /// The fragment in `here` is in this step.
    pub fn first(&self, step: i32) -> Signal<'m> {
        self.here_step.q().eq(step)
    }

    /// The fragment in `there` is in this step.
    pub fn second(&self, step: i32) -> Signal<'m> {
        self.there_step.q().eq(step)
    }

    /// The field of that name of the fragment in `here`.
    pub fn of(&self, name: &str) -> Signal<'m> {
        self.here[name].q()
    }

    /// A register from the first half of a step to the second, or from a step to the next.
    pub fn between(&self, name: &str, doc: &str, value: Signal<'m>) -> Signal<'m> {
        value.module().reg(name, value.width()).doc(doc).when(self.turns, value).q()
    }

    /// A result of each of the two fragments, without updates.
    pub fn result(&self, m: &'m Module, name: &str, bits: u32, doc: &str) -> Made<'m> {
        let here = m.reg(name, bits).doc(doc);
        let there = m.reg(&format!("there_{name}"), bits).doc(&format!("{name} of the fragment in there"));
        there.when(self.turns, here.q());
        here.when(self.turns, there.q());
        Made { turns: self.turns, here, there }
    }
}

/// A result of the fragment in `here`, and of the fragment in `there`.
#[derive(Clone, Copy)]
pub(super) struct Made<'m> {
    turns: Signal<'m>,
    here: Reg<'m>,
    there: Reg<'m>,
}

impl<'m> Made<'m> {
    /// The result of the fragment in `here`.
    pub fn here(&self) -> Signal<'m> {
        self.here.q()
    }

    /// The result of the fragment in `there`.
    pub fn there(&self) -> Signal<'m> {
        self.there.q()
    }

    /// The second half of a step makes the result: `step` is that half.
    pub fn when(&self, step: Signal<'m>, value: Signal<'m>) {
        self.here.when(self.turns & step, value);
    }
}
