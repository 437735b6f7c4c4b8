//! The steps of a fragment: which one it is, and what the fragment brought.

use edgewalk_netlist::{Module, Reg, Signal};

use crate::wires::{Registers, Token};

/// The step in which a fragment is done.
const LAST: i32 = 16;

/// The handshakes of LAMP, as far as the steps read them.
pub(super) struct Links<'m> {
    /// A fragment is offered.
    pub frag_valid: Signal<'m>,
    /// The fragment is accepted behind LAMP.
    pub normed_ready: Signal<'m>,
}

/// Which step it is, and of what.
pub(super) struct Steps<'m> {
    /// A fragment is inside.
    pub busy: Signal<'m>,
    /// The fragment's steps are not all done.
    pub working: Signal<'m>,
    pub normed_valid: Signal<'m>,
    pub frag_ready: Signal<'m>,
    step: Reg<'m>,
    kept: Registers<'m>,
}

impl<'m> Steps<'m> {
    /// The registers; `have`: the tables are there.
    pub fn new(m: &'m Module, frag: &Token<'m>, have: Signal<'m>, links: &Links<'m>) -> Steps<'m> {
        m.comment("Step counter.");
        let busy = m.reg("busy", 1).doc("the unit holds a fragment").reset(0);
        let step = m.reg("step", 5).doc("steps already done");
        let done = step.q().eq(LAST).named("done");
        let normed_valid = (busy.q() & done).named("normed_valid");
        let working = (busy.q() & !done).named("working");
        let goes = (normed_valid & links.normed_ready).named("goes");
        let frag_ready = (have & (!busy.q() | goes)).named("frag_ready");
        let take = (links.frag_valid & frag_ready).named("take");
        busy.when(goes, 0).when(take, 1);
        step.when(working, step.q() + 1).when(take, 0);
        let kept = Registers::new(m, "kept", frag.parts());
        kept.load(take, |f| frag[f]);
        Steps { busy: busy.q(), working, normed_valid, frag_ready, step, kept }
    }

    /// The step is the one of this number.
    pub fn at(&self, number: i32) -> Signal<'m> {
        self.step.q().eq(number)
    }

    /// What the fragment brought under that name.
    pub fn of(&self, name: &str) -> Signal<'m> {
        self.kept[name].q()
    }
}
