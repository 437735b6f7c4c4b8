//! The stages of an operation: named, formed, stepped, and two more until its result stands.

use edgewalk_machine::Fill;
use edgewalk_netlist::{Module, Reg, Signal};

use super::Base;
use super::clocks::doubling_clocks;
use super::codes::Codes;
use super::sequence::Sequence;
use crate::setup::steps::Op;

/// An operation in one of the stages.
pub(in crate::setup) struct Stage<'m> {
    at: Signal<'m>,
    round: Option<Signal<'m>>,
    /// The last clock of the operation.
    pub ends: Signal<'m>,
    codes: Codes<'m>,
}

impl<'m> Stage<'m> {
    /// The stage is at this operation.
    pub fn is(&self, op: Op) -> Signal<'m> {
        self.one_of(&[op])
    }

    /// The stage is at one of these operations; those that the machine does not have do not count.
    pub fn one_of(&self, ops: &[Op]) -> Signal<'m> {
        let codes = self.codes.iter().filter(|(op, _)| ops.contains(op)).map(|(_, code)| self.at.eq(*code));
        codes.reduce(|any, one| any | one).unwrap_or(self.at.module().lit(1, 0))
    }

    /// The stage is at this operation, in this round.
    pub fn is_in(&self, op: Op, round: usize) -> Signal<'m> {
        self.in_round(round).map_or(self.is(op), |is| self.is(op) & is)
    }

    /// The operation ends, in this round.
    pub fn ends_in(&self, op: Op, round: usize) -> Signal<'m> {
        self.ends & self.is_in(op, round)
    }

    /// The stage is in this round; `None` where there is no other.
    pub fn in_round(&self, round: usize) -> Option<Signal<'m>> {
        self.round.map(|number| number.eq(round as i32))
    }

    /// What belongs to the round, of one choice a round; in rounds beyond them the first.
    pub fn of_round(&self, rounds: usize, choice: impl Fn(usize) -> Signal<'m>) -> Signal<'m> {
        (1..rounds).fold(choice(0), |chosen, round| {
            self.in_round(round).map_or(chosen, |is| is.mux(choice(round), chosen))
        })
    }
}

/// The stages, each a clock after the one before.
pub(in crate::setup) struct Way<'m> {
    /// The operation begins: its addends are read.
    pub named: Stage<'m>,
    /// The operation chooses what is loaded. It is held while numbers do not fit: with few doublings DY is
    /// the next to be loaded.
    pub next: Stage<'m>,
    /// The stage whose step is done.
    pub stepped: Stage<'m>,
    /// The rest of its result stands, the whole part is formed.
    pub rest: Stage<'m>,
    /// The stage whose result stands.
    pub whole: Stage<'m>,
    /// The step after the numbers that did not fit is formed again.
    pub(super) resumes: Signal<'m>,
}

impl<'m> Way<'m> {
    /// The registers of all stages.
    pub(super) fn new(base: &Base<'_, 'm>, sequence: &Sequence<'m>) -> Way<'m> {
        let Base { m, plan, codes, counters, pause, .. } = base;
        m.comment("The way of an operation: named, its addends formed, its step done, the rest and then the whole of the result.");
        let round = counters.rounds.number.map(Reg::q);
        let named = Stage { at: counters.at.q(), round, ends: sequence.ends, codes: codes.clone() };
        let register = |name: &str| StageRegister::new(m, name, &named);
        let next = register("next").load(Some(pause.advance), &named);
        let resumes = pause.left.eq(1).named_doc("resumes", "the step after the numbers is formed again");
        // What took in numbers that do not fit, and the step after it: in exact fill only DX may not fit, and
        // is doubled.
        let registers =
            (plan.fill == Fill::Textbook).then(|| (register("again"), m.reg("at_taken", codes.bits())));
        let (again, taken) = match &registers {
            Some((again, taken)) => (again.stage(codes), taken.q()),
            None => {
                let ends = m.lit(1, (doubling_clocks(plan, Op::DoubleDx, 0) < 2).into());
                let (at, round) = (codes.of(Op::DoubleDx), next.round);
                (Stage { at, round, ends, codes: codes.clone() }, codes.of(Op::TakeDx))
            }
        };
        let choose = |resumed: Signal<'m>, taken: Signal<'m>, next: Signal<'m>| {
            pause.advance.mux(next, resumes.mux(resumed, taken))
        };
        let formed = Stage {
            at: choose(again.at, taken, next.at).named("at_formed"),
            // It is of the same round.
            round: again
                .round
                .zip(next.round)
                .map(|(again, next)| pause.advance.mux(next, again).named("round_formed")),
            // The last two digits are formed when two clocks are left.
            ends: choose(again.ends, pause.left.eq(2), next.ends).named("ends_formed"),
            codes: codes.clone(),
        };
        let stepped = register("stepped").load(None, &formed);
        if let Some((again, taken)) = registers {
            again.load(Some(pause.advance), &formed);
            taken.when(pause.advance, stepped.at);
        }
        let rest = register("rest").load(None, &stepped);
        let whole = register("whole").load(None, &rest);
        Way { named, next, stepped, rest, whole, resumes }
    }
}

/// The registers of a stage.
struct StageRegister<'m> {
    at: Reg<'m>,
    round: Option<Reg<'m>>,
    ends: Reg<'m>,
}

impl<'m> StageRegister<'m> {
    /// As wide as another stage.
    fn new(m: &'m Module, name: &str, like: &Stage<'m>) -> StageRegister<'m> {
        StageRegister {
            at: m.reg(&format!("at_{name}"), like.at.width()),
            round: like.round.map(|round| m.reg(&format!("round_{name}"), round.width())),
            ends: m.reg(&format!("ends_{name}"), 1),
        }
    }

    /// Takes the stage before in each clock, or only under a condition.
    fn load(&self, when: Option<Signal<'m>>, from: &Stage<'m>) -> Stage<'m> {
        let go = |reg: Reg<'m>, value: Signal<'m>| match when {
            Some(when) => reg.when(when, value),
            None => reg.set(value),
        };
        go(self.at, from.at);
        if let (Some(to), Some(from)) = (self.round, from.round) {
            go(to, from);
        }
        go(self.ends, from.ends);
        self.stage(&from.codes)
    }

    fn stage(&self, codes: &Codes<'m>) -> Stage<'m> {
        Stage { at: self.at.q(), round: self.round.map(Reg::q), ends: self.ends.q(), codes: codes.clone() }
    }
}
