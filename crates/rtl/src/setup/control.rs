//! The sequence of setup: its states, the operation that begins in a clock, and how far it has come on its way.

use edgewalk_machine::{Channel, Fill, Plan};
use edgewalk_netlist::{Module, Reg, Signal, Wire};

use super::steps::{Length, Op, channel_of, most_scale, round_clocks, rounds};

/// An operation on its way through the lanes: where it is in a clock.
pub(super) struct Stage<'m> {
    at: Signal<'m>,
    round: Option<Signal<'m>>,
    /// The last clock of the operation.
    pub ends: Signal<'m>,
    codes: Vec<(Op, Signal<'m>)>,
}

impl<'m> Stage<'m> {
    /// It is this operation.
    pub fn is(&self, op: Op) -> Signal<'m> {
        self.one_of(&[op])
    }

    /// It is one of these; those that the machine does not have do not count.
    pub fn one_of(&self, ops: &[Op]) -> Signal<'m> {
        let codes = self.codes.iter().filter(|(op, _)| ops.contains(op)).map(|(_, code)| self.at.eq(*code));
        codes.reduce(|any, one| any | one).unwrap_or(self.at.module().lit(1, 0))
    }

    /// It is this operation, in this round.
    pub fn is_in(&self, op: Op, round: usize) -> Signal<'m> {
        self.in_round(round).map_or(self.is(op), |is| self.is(op) & is)
    }

    /// It ends, in this round.
    pub fn ends_in(&self, op: Op, round: usize) -> Signal<'m> {
        self.ends & self.is_in(op, round)
    }

    /// It is this round; `None` where there is no other.
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

/// Where setup stands.
pub(super) struct Control<'m> {
    /// `tri_ready`: nothing is being set up.
    pub idle: Signal<'m>,
    /// A triangle is taken.
    pub take: Signal<'m>,
    /// The clock after: its lines and its area are begun.
    pub begin: Signal<'m>,
    /// `prim_valid`: the triangle is set up.
    pub done: Signal<'m>,
    /// The operation that begins its way: its addends are read.
    pub named: Stage<'m>,
    /// First clock of it.
    pub first: Signal<'m>,
    /// Its clocks after this one.
    pub left: Signal<'m>,
    /// Nothing is done: it waits for the area, gives up, or is not at work.
    pub waits: Signal<'m>,
    /// A clock later: what is loaded is chosen by it. Held while numbers do not fit: with few doublings DY is the next to be
    /// loaded.
    pub next: Stage<'m>,
    /// Two clocks later: its step is done.
    pub stepped: Stage<'m>,
    /// Three: the rest of the result stands, its whole part is formed.
    pub rest: Stage<'m>,
    /// Four: the result stands.
    pub whole: Stage<'m>,
    /// Nothing is held up by numbers that do not fit.
    pub advance: Signal<'m>,
    /// Clocks still needed for these numbers; in the last of them the next step is formed again.
    pub pause: Signal<'m>,
    /// To be driven: the lines are known and there are none, or no columns.
    pub nothing: Wire<'m>,
    /// To be driven: the area is known.
    pub area_known: Wire<'m>,
    /// To be driven: it is 0.
    pub no_area: Wire<'m>,
    /// To be driven: how often the modulus of the round of channels is fourfold.
    pub scale: Wire<'m>,
    /// To be driven: a number that is needed did not fit.
    pub unfit: Wire<'m>,
    /// To be driven: place of the first digit of the next sum.
    pub top_digit: Wire<'m>,
}

impl<'m> Control<'m> {
    /// The registers and their updates.
    pub fn new(m: &'m Module, plan: &Plan, tri_valid: Signal<'m>, prim_ready: Signal<'m>) -> Control<'m> {
        m.comment("Control: the operations one after the other, a clock each or more; in rounds where there are more jobs than lanes.");
        let state_of = |name, value| m.constant(name, 2, value);
        let (idle, at_work) = (state_of("IDLE", 0), state_of("WORK", 1));
        let (store, done) = (state_of("STORE", 2), state_of("DONE", 3));
        let ops: Vec<Op> = Op::of_edges(plan).iter().chain(Op::of_channels(plan)).copied().collect();
        let bits = (ops.len() as u32).next_power_of_two().ilog2();
        let constant = |(i, op): (usize, &Op)| (*op, m.constant(&name_of(*op), bits, i as u128));
        let codes: Vec<(Op, Signal)> = ops.iter().enumerate().map(constant).collect();
        let last_edge = Op::of_edges(plan).len() - 1;
        let (first_channel, last_channel) = (last_edge + 1, ops.len() - 1);

        let nothing = m.wire("nothing", 1).doc("no line, or no column, of the screen");
        let area_known = m.wire("area_known", 1).doc("and scaled for the next round of channels");
        let no_area = m.wire("no_area", 1);
        let scale =
            m.wire("scale", most_scale(plan).ilog2() + 1).doc("the modulus is the area 4^scale times");
        let unfit = m.wire("unfit", 1).doc("a number was taken in that is not between -M and M");
        let longest = ops.iter().map(|op| clocks(plan, *op)).max().unwrap_or(1).max(4);
        let digits = plan.widths().difference; // a sum has as many at most, without the sign
        let left_bits = longest.max(digits).ilog2() + 1;
        let top_digit = m.wire("top_digit", left_bits).doc("place of the first digit of a sum");

        let state = m.reg("state", 2).reset(0);
        let at = m.reg("at", bits).doc("operation");
        let left = m.reg("left", left_bits).doc("its clocks after this one");
        let first = m.reg("first", 1).doc("its first clock, but for that of a triangle");
        let [edge_rounds, channel_rounds] = rounds(plan);
        let most = edge_rounds.max(channel_rounds);
        let round = (most > 1).then(|| {
            m.reg("round", (most as u32).next_power_of_two().ilog2()).doc("of the jobs the lanes do in turn")
        });
        let is_round = |number: usize| round.map(|round| round.q().eq(number as i32));
        let with = |a: Signal<'m>, b: Option<Signal<'m>>| b.map_or(a, |b| a & b);

        m.comment("Numbers that do not fit hold up what follows: two clocks, and one for two digits.");
        let of_parts = (0..most).filter(|_| plan.fill == Fill::Textbook).map(|round| pairs(plan, round));
        let most_pairs = of_parts.chain([edge_pairs(plan)]).max().unwrap_or(1);
        let pause = m.reg("pause", (most_pairs + 2).ilog2() + 1).doc("clocks left of it");
        let paused = m.reg("paused", 1).doc("it is not over").reset(0);
        let advance = (!paused.q()).named("advance");

        let is_idle = state.q().eq(idle).named("tri_ready");
        let take = (tri_valid & is_idle).named("take");
        let works = state.q().eq(at_work).named("works");
        let is_done = state.q().eq(done).named("prim_valid");
        let is_at = |place: usize| at.q().eq(codes[place].1);
        let begin = (works & is_at(0)).named_doc("begins", "the first clock of a triangle");
        let gives_up = with(works & is_at(1), is_round(0)) & nothing.q();
        let gives_up = gives_up.named_doc("gives_up", "the triangle has no line or no column");
        let last = (left.q().eq(0)).named_doc("last", "last clock of the operation");
        let edges_end = with(last & is_at(last_edge), is_round(edge_rounds - 1)).named("edges_end");
        let mut begins_channels = edges_end;
        if channel_rounds > 1 {
            let turn = last & is_at(last_channel);
            let turn = is_round(channel_rounds - 1).map_or(turn, |is_last| turn & !is_last);
            begins_channels = edges_end | turn.named("round_ends");
        }
        let waits = (begins_channels & !area_known.q()).named_doc("waits", "for the area or its scale");
        let goes = (works & !waits & !gives_up).named_doc("goes", "the operation is done");
        let ends = (goes & last).named_doc("ends", "it ends");
        let leaves = (ends & advance).named("leaves");
        let channels_end = with(is_at(last_channel), is_round(channel_rounds - 1)).named("channels_end");

        state
            .when(take, at_work)
            .when(gives_up & advance, idle)
            .when(edges_end & leaves & no_area.q(), idle)
            .when(leaves & channels_end, store)
            .when(state.q().eq(store) & last, done)
            .when(is_done & prim_ready, idle);
        let mut next = at.q() + 1;
        if edge_rounds > 1 {
            next = (is_at(last_edge) & !edges_end).mux(codes[1].1, next); // the vertices are subtracted already
        }
        if channel_rounds > 1 {
            next = (is_at(last_channel) & !channels_end).mux(codes[first_channel].1, next);
        }
        at.when(leaves, next).when(take, codes[0].1);
        match plan.fill {
            // A sum of one digit may wait for the area.
            Fill::Exact => first.set(leaves | (first.q() & waits)),
            // A sum may be named while numbers do not fit.
            Fill::Textbook => first.when(advance, leaves | (first.q() & waits)),
        };
        if let Some(round) = round {
            round
                .when(leaves & (is_at(last_edge) | is_at(last_channel)), round.q() + 1)
                .when((leaves & edges_end) | take, 0);
        }

        m.comment("How long the next operation takes.");
        let doubled =
            |op: Op, round: usize| m.lit(left_bits, u128::from(doubling_clocks(plan, op, round).max(1)) - 1);
        let of_channels = |op: Op| {
            let clocks = |round: usize| doubling_clocks(plan, op, round);
            let last = channel_rounds - 1;
            let others = (0..last).filter(|round| clocks(*round) != clocks(last));
            others.fold(doubled(op, last), |chosen, number| {
                is_round(number).map_or(chosen, |is| is.mux(doubled(op, number), chosen))
            })
        };
        let mut length = m.lit(left_bits, 0);
        for (before, (op, _)) in codes.iter().enumerate().skip(1).map(|(i, code)| (i - 1, code)) {
            let clocks = match op.doing().length {
                Length::Clocks(1) => continue,
                Length::Clocks(clocks) => m.lit(left_bits, u128::from(clocks) - 1),
                Length::Digits => top_digit.q(),
                Length::Doublings(_) if op.is_of_edge(plan) && doubling_clocks(plan, *op, 0) < 2 => continue,
                Length::Doublings(_) if op.is_of_edge(plan) => doubled(*op, 0),
                Length::Doublings(_) => of_channels(*op),
                Length::Scaled(_) => of_channels(*op) + scale.q().zext(left_bits),
            };
            length = is_at(before).mux(clocks, length);
        }
        left.when(advance & works, left.q() - 1)
            .when(leaves, length)
            .when(leaves & channels_end, 3)
            .when(state.q().eq(store), left.q() - 1)
            .when(waits, 0)
            .when(take, 0);

        m.comment("The way of an operation: named, its addends formed, its step done, the rest and then the whole of the result.");
        let stage = |at, round: Option<Signal<'m>>, ends| Stage { at, round, ends, codes: codes.clone() };
        let named = stage(at.q(), round.map(Reg::q), ends);
        let held = |name: &str| {
            (
                m.reg(&format!("at_{name}"), bits),
                round.map(|r| m.reg(&format!("round_{name}"), r.q().width())),
                m.reg(&format!("ends_{name}"), 1),
            )
        };
        let moved = |to: &(Reg<'m>, Option<Reg<'m>>, Reg<'m>), when: Option<Signal<'m>>, from: &Stage<'m>| {
            let go = |reg: Reg<'m>, value: Signal<'m>| match when {
                Some(when) => reg.when(when, value),
                None => reg.set(value),
            };
            go(to.0, from.at);
            if let (Some(to), Some(from)) = (to.1, from.round) {
                go(to, from);
            }
            go(to.2, from.ends);
            stage(to.0.q(), to.1.map(Reg::q), to.2.q())
        };
        let next = moved(&held("next"), Some(advance), &named);
        let resumes = pause.q().eq(1).named_doc("resumes", "the step after the numbers is formed again");
        // What took in numbers that do not fit, and the step after it: in exact fill only DX may not fit, and is doubled.
        let registers = (plan.fill == Fill::Textbook).then(|| (held("again"), m.reg("at_taken", bits)));
        let (again, taken) = match registers {
            Some((again, taken)) => (stage(again.0.q(), again.1.map(Reg::q), again.2.q()), taken.q()),
            None => {
                let at_once = m.lit(1, (doubling_clocks(plan, Op::DoubleDx, 0) < 2).into());
                (stage(code_of(&codes, Op::DoubleDx), next.round, at_once), code_of(&codes, Op::TakeDx))
            }
        };
        let choose = |resumed: Signal<'m>, taken: Signal<'m>, next: Signal<'m>| {
            advance.mux(next, resumes.mux(resumed, taken))
        };
        let formed = stage(
            choose(again.at, taken, next.at).named("at_formed"),
            // It is of the same round.
            again.round.zip(next.round).map(|(again, next)| advance.mux(next, again).named("round_formed")),
            // The last two digits are formed when two clocks are left.
            choose(again.ends, pause.q().eq(2), next.ends).named("ends_formed"),
        );
        let stepped = moved(&held("stepped"), None, &formed);
        if let Some((again, taken)) = registers {
            moved(&again, Some(advance), &formed);
            taken.when(advance, stepped.at);
        }
        let rest = moved(&held("rest"), None, &stepped);
        let whole = moved(&held("whole"), None, &rest);
        let needed = |round: usize| m.lit(pause.q().width(), u128::from(pairs(plan, round)) + 2);
        let mut clocks = m.lit(pause.q().width(), u128::from(edge_pairs(plan)) + 2);
        if plan.fill == Fill::Textbook {
            clocks = stepped.is(Op::TakeDx).mux(clocks, stepped.of_round(channel_rounds, needed));
        }
        pause.set(advance.mux(clocks, pause.q() - 1));
        // What the lanes do right after a reset is of no triangle.
        let worked = m.reg("worked", 1).doc("works, a clock ago").reset(0).set(works).q();
        paused.when(resumes, 0).when(worked & unfit.q(), 1);

        Control {
            idle: is_idle,
            take,
            begin,
            done: is_done,
            named,
            first: first.q(),
            left: left.q(),
            waits: (!goes).named("rests"),
            next,
            stepped,
            rest,
            whole,
            advance,
            pause: pause.q(),
            nothing,
            area_known,
            no_area,
            scale,
            unfit,
            top_digit,
        }
    }
}

/// The number of an operation that the machine has.
fn code_of<'m>(codes: &[(Op, Signal<'m>)], op: Op) -> Signal<'m> {
    codes[codes.iter().position(|(other, _)| *other == op).unwrap_or(0)].1
}

/// Clocks of an operation that does not depend on the triangle; of one that doubles the most.
fn clocks(plan: &Plan, op: Op) -> u32 {
    match op.doing().length {
        Length::Clocks(clocks) => clocks,
        Length::Digits => 1,
        Length::Doublings(number) => most_clocks(plan, number),
        Length::Scaled(number) => most_clocks(plan, number) + most_scale(plan),
    }
}

/// Clocks in which an operation doubles in a round; 0 of one that does not.
fn doubling_clocks(plan: &Plan, op: Op, round: usize) -> u32 {
    match op.doing().length {
        Length::Doublings(doublings) | Length::Scaled(doublings) => {
            round_clocks(plan, doublings, op.is_of_edge(plan), round)
        }
        Length::Clocks(_) | Length::Digits => 0,
    }
}

/// Clocks of the channel that is doubled the most.
fn most_clocks(plan: &Plan, doublings: fn(&Plan, &Channel) -> u32) -> u32 {
    plan.channels().iter().map(|channel| doublings(plan, channel).div_ceil(2)).max().unwrap_or(1)
}

/// Pairs of digits of the longest vertex value in a round.
fn pairs(plan: &Plan, round: usize) -> u32 {
    let channels = (0..plan.lanes as usize).filter_map(|lane| channel_of(plan, lane, round));
    channels.map(|channel| channel.vertex_bits().div_ceil(2)).max().unwrap_or(1)
}

/// Pairs of digits of a difference of coordinates.
fn edge_pairs(plan: &Plan) -> u32 {
    (plan.widths().difference - 1).div_ceil(2)
}

/// `FixDx` as `FIX_DX`.
fn name_of(op: Op) -> String {
    let mut name = String::new();
    for c in format!("{op:?}").chars() {
        if c.is_ascii_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.push(c.to_ascii_uppercase());
    }
    name
}
