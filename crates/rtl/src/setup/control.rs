//! The sequence of setup: its states, the operation of the lanes, and the clock within it.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal, Wire};

use super::schedule::{self, Kind, Op};

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
    round: Round<'m>,
    finished_round: Round<'m>,
}

struct OpSignals<'m> {
    op: Op,
    now: Signal<'m>,
    /// A quotient was finished in the clock before; `None` for a product.
    finished: Option<Signal<'m>>,
}

/// The number of a round; there is none where the lanes do everything in one.
#[derive(Clone, Copy)]
struct Round<'m>(Option<Reg<'m>>);

impl<'m> Control<'m> {
    /// The registers and their updates.
    pub fn new(m: &'m Module, plan: &Plan, tri_valid: Signal<'m>, prim_ready: Signal<'m>) -> Control<'m> {
        m.comment(
            "Control. Sorting takes three clocks; an operation takes one to load, then k bits a clock.",
        );
        let state_of = |name, value| m.constant(name, 3, value);
        let (idle, sort, edges) = (state_of("IDLE", 0), state_of("SORT", 1), state_of("EDGES", 2));
        let (channels, store, done) = (state_of("CHANNELS", 3), state_of("STORE", 4), state_of("DONE", 5));
        let ops: Vec<Op> = Op::of_edges().iter().chain(Op::of_channels(plan)).copied().collect();
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

        let longest = ops.iter().map(|op| op.steps(plan)).max().unwrap_or(1).max(2);
        let step = m.reg("step", longest.ilog2() + 1).doc("clock of the operation; 0 loads");
        let op = m.reg("op", 4).doc("operation of the lanes");
        let round = Round::new(m, plan, "round");
        let load = (working & step.q().eq(0)).named("load");
        let stepping = (working & step.q().any()).named("stepping");
        let is_now =
            |(code, op_of): (&Signal<'m>, &Op)| op.q().eq(*code).named(&format!("is_{}", op_of.word()));
        let now: Vec<Signal> = codes.iter().zip(&ops).map(is_now).collect();
        // All products take the same time.
        let product = m.lit(step.q().width(), Op::EdgeProduct.steps(plan).into());
        let quotients = ops.iter().zip(&now).filter(|(op, _)| op.kind() != Kind::Product);
        let steps = quotients.fold(product, |chosen, (op, now)| now.mux(op.steps(plan) as i32, chosen));
        let steps = steps.named_doc("steps", "clocks of the operation after the one that loads");
        let last_step = (working & step.q().eq(steps)).named("last_step");
        let edges_end = (last_step & op.q().eq(last_of_edges)).named("edges_end");
        let channels_end = (last_step & op.q().eq(last_of_channels)).named("channels_end");
        let [edge_rounds, channel_rounds] = schedule::rounds(plan);
        let last_of = |rounds: usize| if rounds > 1 { round.is(rounds - 1) } else { None };
        let last_edges = last_of(edge_rounds);
        let last_channels = if channel_rounds == edge_rounds { last_edges } else { last_of(channel_rounds) };
        let and_last = |end: Signal<'m>, last: Option<Signal<'m>>| last.map_or(end, |last| end & last);
        let sorted = (sorting & step.q().eq(2)).named("sorted");

        state
            .when(take, sort)
            .when(sorted, edges)
            .when(and_last(edges_end, last_edges), cull.q().mux(idle, channels))
            .when(and_last(channels_end, last_channels), store)
            .when(state.q().eq(store), done)
            .when(is_done & prim_ready, idle);
        step.when(sorting | working, step.q() + 1).when(take | sorted | last_step, 0);
        op.when(last_step, op.q() + 1)
            .when(
                edges_end,
                last_edges.map_or(first_of_channels, |last| last.mux(first_of_channels, first_of_edges)),
            )
            .when(channels_end, first_of_channels)
            .when(take, first_of_edges);
        if let Some(register) = round.0 {
            register.when(edges_end | channels_end, register.q() + 1);
            // After the last round of the edges the channels begin with round 0; a full counter is there of itself.
            if edge_rounds != 1 << register.q().width() {
                register.when(and_last(edges_end, last_edges), 0);
            }
            register.when(take, 0);
        }

        m.comment("Quotients are taken in the clock after the last step.");
        let finished = m.reg("finished", 1).doc("an operation ended").reset(0).set(last_step);
        let finished_op = m.reg("finished_op", 4).doc("which").set(op);
        let finished_round = Round::new(m, plan, "finished_round");
        if let (Some(register), Some(round)) = (finished_round.0, round.0) {
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
            round,
            finished_round,
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
        self.finished_round.is(round).map_or(after, |is| after & is)
    }

    /// An operation loads, in this round.
    pub fn load_in(&self, op: Op, round: usize) -> Signal<'m> {
        let load = self.load & self.during(&[op]);
        self.round.is(round).map_or(load, |is| load & is)
    }

    /// What belongs to the round, of one choice a round; in rounds beyond them the first.
    pub fn of_round(&self, rounds: usize, choice: impl Fn(usize) -> Signal<'m>) -> Signal<'m> {
        (1..rounds).fold(choice(0), |chosen, round| {
            self.round.is(round).map_or(chosen, |is| is.mux(choice(round), chosen))
        })
    }
}

impl<'m> Round<'m> {
    fn new(m: &'m Module, plan: &Plan, name: &str) -> Round<'m> {
        let most = schedule::rounds(plan).into_iter().max().unwrap_or(1);
        let bits = most.next_power_of_two().ilog2();
        Round((most > 1).then(|| m.reg(name, bits).doc("of the jobs the lanes do in turn")))
    }

    /// It is this round; `None` where there is no other.
    fn is(self, round: usize) -> Option<Signal<'m>> {
        self.0.map(|register| register.q().eq(round as i32))
    }
}
