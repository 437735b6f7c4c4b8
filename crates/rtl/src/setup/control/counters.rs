//! The registers that say which operation begins, and how far it is.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal};

use crate::setup::steps::rounds;

/// The states of SETUP.
pub(super) struct States<'m> {
    /// `tri_ready`.
    pub idle: Signal<'m>,
    /// Operations are done.
    pub work: Signal<'m>,
    /// The last results are still on their way.
    pub store: Signal<'m>,
    /// `prim_valid`.
    pub done: Signal<'m>,
}

impl<'m> States<'m> {
    /// A constant each.
    pub fn new(m: &'m Module) -> States<'m> {
        let state = |name, number| m.constant(name, 2, number);
        States {
            idle: state("IDLE", 0),
            work: state("WORK", 1),
            store: state("STORE", 2),
            done: state("DONE", 3),
        }
    }
}

/// Where the sequence is.
pub(super) struct Counters<'m> {
    /// One of [`States`].
    pub state: Reg<'m>,
    /// The operation that begins.
    pub at: Reg<'m>,
    /// Clocks of the operation after this one.
    pub left: Reg<'m>,
    /// First clock of the operation.
    pub first: Reg<'m>,
    pub rounds: Rounds<'m>,
}

impl<'m> Counters<'m> {
    /// The registers, without updates.
    pub fn new(m: &'m Module, plan: &Plan, op_bits: u32, left_bits: u32) -> Counters<'m> {
        Counters {
            state: m.reg("state", 2).reset(0),
            at: m.reg("at", op_bits).doc("operation"),
            left: m.reg("left", left_bits).doc("clocks of the operation after this one"),
            first: m.reg("first", 1).doc("first clock of an operation, except of a triangle's first"),
            rounds: Rounds::new(m, plan),
        }
    }
}

/// The rounds in which the lanes do their jobs.
pub(super) struct Rounds<'m> {
    /// The round; `None` where one is enough.
    pub number: Option<Reg<'m>>,
    /// Rounds of edges.
    pub of_edges: usize,
    /// Rounds of channels.
    pub of_channels: usize,
}

impl<'m> Rounds<'m> {
    fn new(m: &'m Module, plan: &Plan) -> Rounds<'m> {
        let [of_edges, of_channels] = rounds(plan);
        let most = of_edges.max(of_channels);
        let register = || {
            m.reg("round", (most as u32).next_power_of_two().ilog2()).doc("of the jobs the lanes do in turn")
        };
        Rounds { number: (most > 1).then(register), of_edges, of_channels }
    }

    /// The counter is at this round; `None` where there is no other.
    pub fn is(&self, number: usize) -> Option<Signal<'m>> {
        self.number.map(|round| round.q().eq(number as i32))
    }

    /// The condition, in this round.
    pub fn during(&self, condition: Signal<'m>, number: usize) -> Signal<'m> {
        self.is(number).map_or(condition, |is| condition & is)
    }
}
