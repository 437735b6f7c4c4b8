//! The sequence of setup: its states, the operation of the lanes, and the clock within it.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal, Wire};

use super::schedule::{Kind, Op};

/// Where setup stands.
pub(super) struct Control<'m> {
    /// `tri_ready`: nothing is being set up.
    pub idle: Signal<'m>,
    /// A triangle is taken.
    pub take: Signal<'m>,
    /// One of the three clocks of sorting; `step` says which.
    pub sorting: Signal<'m>,
    /// The operations on edges, not those on channels.
    pub in_edges: Signal<'m>,
    /// Clock of the operation, or of the sorting.
    pub step: Signal<'m>,
    /// The operation loads.
    pub load: Signal<'m>,
    /// The operation does its k bits.
    pub stepping: Signal<'m>,
    /// `prim_valid`: the triangle is set up.
    pub done: Signal<'m>,
    /// To be driven: the triangle draws nothing.
    pub cull: Wire<'m>,
    ops: Vec<OpSignals<'m>>,
    rounds: Rounds<'m>,
    finished_rounds: Rounds<'m>,
}

struct OpSignals<'m> {
    op: Op,
    now: Signal<'m>,
    /// A quotient was finished in the clock before; `None` for a product.
    finished: Option<Signal<'m>>,
}

/// A counter of rounds; there is none where all lanes do everything in one.
#[derive(Clone, Copy)]
struct Rounds<'m> {
    register: Option<Reg<'m>>,
    count: usize,
}

impl<'m> Control<'m> {
    /// The registers and their updates.
    pub fn new(m: &'m Module, machine: &Plan, tri_valid: Signal<'m>, prim_ready: Signal<'m>) -> Control<'m> {
        m.comment(
            "Control. Sorting takes three clocks; an operation takes one to load, then k bits a clock.",
        );
        let state_of = |name, value| m.constant(name, 3, value);
        let (idle, sort, edges) = (state_of("IDLE", 0), state_of("SORT", 1), state_of("EDGES", 2));
        let (channels, store, done) = (state_of("CHANNELS", 3), state_of("STORE", 4), state_of("DONE", 5));
        let ops: Vec<Op> = Op::of_edges().iter().chain(Op::of_channels(machine)).copied().collect();
        let constant = |(i, op): (usize, &Op)| m.constant(&op.word().to_uppercase(), 4, i as u128);
        let codes: Vec<Signal> = ops.iter().enumerate().map(constant).collect();
        let (first_of_edges, first_of_channels) = (codes[0], codes[Op::of_edges().len()]);
        let (last_of_edges, last_of_channels) = (codes[Op::of_edges().len() - 1], codes[codes.len() - 1]);

        let cull = m.wire("cull", 1).doc("no area, or no line on the screen");
        let state = m.reg("state", 3).reset(0);
        let is_idle = state.q().eq(idle).named("tri_ready");
        let take = (tri_valid & is_idle).named("take");
        let sorting = state.q().eq(sort).named("sorting");
        let in_edges = state.q().eq(edges).named("in_edges");
        let working = (in_edges | state.q().eq(channels)).named("working");
        let is_done = state.q().eq(done).named("prim_valid");

        let longest = ops.iter().map(|op| op.steps(machine)).max().unwrap_or(1).max(2);
        let step = m.reg("step", longest.ilog2() + 1).doc("clock of the operation; 0 loads");
        let op = m.reg("op", 4).doc("operation of the lanes");
        let rounds = Rounds::new(m, machine, "round");
        let load = (working & step.q().eq(0)).named("load");
        let stepping = (working & step.q().any()).named("stepping");
        let is_now =
            |(code, op_of): (&Signal<'m>, &Op)| op.q().eq(*code).named(&format!("is_{}", op_of.word()));
        let now: Vec<Signal> = codes.iter().zip(&ops).map(is_now).collect();
        // All products take the same time.
        let product = m.lit(step.q().width(), Op::EdgeProduct.steps(machine).into());
        let quotients = ops.iter().zip(&now).filter(|(op, _)| op.kind() != Kind::Product);
        let steps = quotients.fold(product, |chosen, (op, now)| now.mux(op.steps(machine) as i32, chosen));
        let steps = steps.named_doc("steps", "clocks of the operation after the one that loads");
        let last_step = (working & step.q().eq(steps)).named("last_step");
        let edges_end = (last_step & op.q().eq(last_of_edges)).named("edges_end");
        let channels_end = (last_step & op.q().eq(last_of_channels)).named("channels_end");
        let last_round = rounds.is(rounds.count - 1);
        let all = |end: Signal<'m>| last_round.map_or(end, |last| end & last);
        let sorted = (sorting & step.q().eq(2)).named("sorted");

        state
            .when(take, sort)
            .when(sorted, edges)
            .when(all(edges_end), cull.q().mux(idle, channels))
            .when(all(channels_end), store)
            .when(state.q().eq(store), done)
            .when(is_done & prim_ready, idle);
        step.when(sorting | working, step.q() + 1).when(take | sorted | last_step, 0);
        op.when(last_step, op.q() + 1)
            .when(
                edges_end,
                last_round.map_or(first_of_channels, |last| last.mux(first_of_channels, first_of_edges)),
            )
            .when(channels_end, first_of_channels)
            .when(take, first_of_edges);
        if let Some(round) = rounds.register {
            round.when(edges_end | channels_end, round.q() + 1).when(take, 0);
        }

        m.comment("Quotients are taken in the clock after the last step.");
        let finished = m.reg("finished", 1).doc("an operation ended").reset(0).set(last_step);
        let finished_op = m.reg("finished_op", 4).doc("which").set(op);
        let finished_rounds = Rounds::new(m, machine, "finished_round");
        if let (Some(register), Some(round)) = (finished_rounds.register, rounds.register) {
            register.set(round);
        }
        let signals = |((op, code), now): ((&Op, &Signal<'m>), &Signal<'m>)| OpSignals {
            op: *op,
            now: *now,
            finished: (op.kind() != Kind::Product)
                .then(|| (finished.q() & finished_op.q().eq(*code)).named(&format!("{}_done", op.word()))),
        };
        let ops = ops.iter().zip(&codes).zip(&now).map(signals).collect();
        let step = step.q();
        let (idle, done) = (is_idle, is_done);
        Control {
            idle,
            take,
            sorting,
            in_edges,
            step,
            load,
            stepping,
            done,
            cull,
            ops,
            rounds,
            finished_rounds,
        }
    }

    /// Whether one of these operations is at work; those that the machine does not have do not count.
    pub fn during(&self, wanted: &[Op]) -> Signal<'m> {
        let which = self.ops.iter().filter(|signals| wanted.contains(&signals.op)).map(|signals| signals.now);
        which.reduce(|any, one| any | one).unwrap_or(self.idle.module().lit(1, 0))
    }

    /// The operations of the machine.
    pub fn ops(&self) -> impl Iterator<Item = Op> {
        self.ops.iter().map(|signals| signals.op)
    }

    /// A quotient was finished in the clock before, in any round.
    pub fn after(&self, op: Op) -> Signal<'m> {
        let found = self.ops.iter().find(|signals| signals.op == op).and_then(|signals| signals.finished);
        found.unwrap_or(self.idle.module().lit(1, 0))
    }

    /// A quotient was finished in the clock before, in this round.
    pub fn after_in(&self, op: Op, round: usize) -> Signal<'m> {
        let after = self.after(op);
        self.finished_rounds.is(round).map_or(after, |is| after & is)
    }

    /// An operation loads, in this round.
    pub fn load_in(&self, op: Op, round: usize) -> Signal<'m> {
        let load = self.load & self.during(&[op]);
        self.rounds.is(round).map_or(load, |is| load & is)
    }

    /// What belongs to the round, of one choice a round.
    pub fn of_round(&self, choice: impl Fn(usize) -> Signal<'m>) -> Signal<'m> {
        self.rounds.choose(choice)
    }
}

impl<'m> Rounds<'m> {
    fn new(m: &'m Module, machine: &Plan, name: &str) -> Rounds<'m> {
        let count = 4 / machine.lanes;
        let register =
            (count > 1).then(|| m.reg(name, count.ilog2()).doc("of the jobs the lanes do in turn"));
        Rounds { register, count: count as usize }
    }

    /// It is this round; `None` where there is no other.
    fn is(self, round: usize) -> Option<Signal<'m>> {
        self.register.map(|register| register.q().eq(round as i32))
    }

    fn choose(self, choice: impl Fn(usize) -> Signal<'m>) -> Signal<'m> {
        (1..self.count).fold(choice(0), |chosen, round| {
            self.is(round).map_or(chosen, |is| is.mux(choice(round), chosen))
        })
    }
}
