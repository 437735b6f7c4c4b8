//! What SETUP does in which order: the operations of a round, and the steps of the lanes they are made of.

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{Module, Signal};

/// A step of a lane (`docs/machine.md`, section 2). Of its number bit 4 says that the addend is a stored
/// pair, bit 3 that M is taken off, bits 1 and 0 together that M less the addend is formed: the lane reads
/// them off where time is short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Nothing.
    Rest = 0,
    /// Doubled.
    Double1 = 0b1,
    /// A number is taken in, and M added if it is below 0; does it fit?
    Take = 0b11,
    /// The sign of a number that does not fit is taken in.
    Begin = 0b111,
    /// Doubled twice.
    Double2 = 0b1000,
    /// The next two digits of a number that does not fit.
    Digits = 0b1001,
    /// A pair is added.
    Add = 0b1_0000,
    /// The first digits of a sum.
    First = 0b1_0001,
    /// The next digits of a sum.
    Next = 0b1_0010,
    /// The sign digits of a sum, which subtract: its first.
    Sign = 0b1_0011,
}

impl Step {
    /// Bits of its number.
    pub const BITS: u32 = 5;
}

/// The numbers of the steps, as named constants of a module.
pub(super) struct StepCodes<'m> {
    codes: Vec<(Step, Signal<'m>)>,
}

impl<'m> StepCodes<'m> {
    /// A constant a step.
    pub fn new(m: &'m Module) -> StepCodes<'m> {
        use Step::*;
        m.comment("The steps of a lane. Bit 4: a stored pair is added. Bit 3: M is taken off. Bits 1 and 0: it subtracts.");
        let steps = [Rest, Double1, Take, Begin, Double2, Digits, Add, First, Next, Sign];
        let code = |step: Step| {
            let name = format!("STEP_{step:?}").to_uppercase();
            (step, m.constant(&name, Step::BITS, step as u128))
        };
        StepCodes { codes: steps.map(code).to_vec() }
    }

    /// The constant of a step.
    pub fn of(&self, step: Step) -> Signal<'m> {
        let found = self.codes.iter().find(|(other, _)| *other == step);
        found.expect("every step has a constant").1
    }
}

/// An operation of all lanes: one step, or as many as its numbers have digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    /// The differences of the vertices are formed.
    Subtract,
    /// DX of an edge.
    TakeDx,
    /// q and f.
    DoubleDx,
    /// DY.
    TakeDy,
    AddDx,
    WaitDx,
    /// N of an edge, without whole columns: C and R of an exact edge.
    Sum,
    /// C and R of a slope edge.
    DoubleColumns,
    RoundColumns,
    /// dc1 - dc2 of a channel.
    Take12,
    /// dc1.
    Take1,
    /// -dc2.
    Take2,
    Wait,
    /// gx.
    SumX,
    DoubleX,
    /// d0: the gradient along the major edge.
    SignLine,
    SumLine,
    DoubleLine,
    /// d1.
    AddX,
    WaitLine,
    /// With POLY, where the signs of start's factors may ask for d1.
    WaitLonger,
    /// start.
    SignStart,
    SumStart,
    /// Textbook fill: g is rounded before the modulus changes.
    RoundX,
    /// DC of part 1.
    TakeA,
    /// dA.
    DoubleA,
    WaitA,
    /// startA.
    SumA,
    DoubleStartA,
    RoundA,
    /// Part 2.
    TakeB,
    /// dB.
    DoubleB,
    WaitB,
    /// startB.
    SumB,
    DoubleStartB,
    RoundB,
}

/// How many clocks an operation takes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Length {
    Clocks(u32),
    /// As many as its numbers have digits.
    Digits,
    /// Doublings, by the channel; two a clock.
    Doublings(fn(&Plan, &Channel) -> u32),
    /// Doublings, and the scale of the round once more, two a clock.
    Scaled(fn(&Plan, &Channel) -> u32),
}

/// What an operation does to the lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Doing {
    pub step: Step,
    pub length: Length,
    /// The slot read, 0 for none; of sums, whose a, b and a + b are the next three, the one before them.
    pub slot: u32,
    /// The slot that takes the result.
    pub result: Option<u32>,
}

impl Op {
    /// The operations on each edge, in their order; the first only before the first round.
    pub fn of_edges(plan: &Plan) -> &'static [Op] {
        use Op::*;
        match plan.edge_kind {
            EdgeKind::Exact => &[Subtract, TakeDx, DoubleDx, TakeDy, AddDx, WaitDx, Sum],
            EdgeKind::Slope => {
                &[Subtract, TakeDx, DoubleDx, TakeDy, AddDx, WaitDx, Sum, DoubleColumns, RoundColumns]
            }
        }
    }

    /// The operations on each channel, in their order.
    pub fn of_channels(plan: &Plan) -> &'static [Op] {
        use Op::*;
        match plan.fill {
            Fill::Exact if plan.polygon.is_there() => &[
                Take12, Take1, Take2, Wait, SumX, DoubleX, SignLine, SumLine, DoubleLine, AddX, WaitLonger,
                SignStart, SumStart,
            ],
            Fill::Exact => &[
                Take12, Take1, Take2, Wait, SumX, DoubleX, SignLine, SumLine, DoubleLine, AddX, WaitLine,
                SignStart, SumStart,
            ],
            Fill::Textbook => &[
                Take12,
                Take1,
                Take2,
                Wait,
                SumX,
                DoubleX,
                RoundX,
                TakeA,
                DoubleA,
                WaitA,
                SumA,
                DoubleStartA,
                RoundA,
                TakeB,
                DoubleB,
                WaitB,
                SumB,
                DoubleStartB,
                RoundB,
            ],
        }
    }

    /// All operations of the machine, in their order.
    pub fn all(plan: &Plan) -> impl Iterator<Item = Op> {
        Op::of_edges(plan).iter().chain(Op::of_channels(plan)).copied()
    }

    /// What it does.
    pub fn doing(self) -> Doing {
        use Op::*;
        let (step, length, slot, result) = match self {
            TakeDx | Take2 => (Step::Take, Length::Clocks(1), 0, Some(2)),
            TakeDy | Take1 | TakeA | TakeB => (Step::Take, Length::Clocks(1), 0, Some(1)),
            Take12 => (Step::Take, Length::Clocks(1), 0, Some(3)),
            DoubleDx => (Step::Double2, Length::Doublings(of_slope), 0, None),
            DoubleColumns => (Step::Double2, Length::Doublings(of_columns), 0, None),
            AddDx => (Step::Add, Length::Clocks(1), 2, Some(3)),
            Subtract | Wait | WaitLine | WaitA | WaitB => (Step::Rest, Length::Clocks(1), 0, None),
            WaitDx | WaitLonger | RoundColumns | RoundX | RoundA | RoundB => {
                (Step::Rest, Length::Clocks(2), 0, None)
            }
            Sum | SumX | SumA | SumB => (Step::First, Length::Digits, 0, None),
            DoubleX => (Step::Double2, Length::Scaled(of_gradient), 0, Some(5)),
            DoubleLine => (Step::Double2, Length::Scaled(of_gradient), 0, Some(6)),
            DoubleStartA | DoubleStartB => (Step::Double2, Length::Doublings(of_gradient), 0, None),
            DoubleA | DoubleB => (Step::Double2, Length::Doublings(of_left_edge), 0, None),
            SignLine => (Step::Sign, Length::Clocks(1), 0, None),
            SignStart => (Step::Sign, Length::Clocks(1), 4, None),
            SumLine => (Step::Next, Length::Digits, 0, None),
            SumStart => (Step::Next, Length::Digits, 4, None),
            AddX => (Step::Add, Length::Clocks(1), 5, Some(7)),
        };
        Doing { step, length, slot, result }
    }

    /// The one whose result is the column of an edge's first line.
    pub fn of_column(plan: &Plan) -> Op {
        match plan.edge_kind {
            EdgeKind::Exact => Op::Sum,
            EdgeKind::Slope => Op::DoubleColumns,
        }
    }

    /// Whether the step belongs to the rounds of edges.
    pub fn is_of_edge(self, plan: &Plan) -> bool {
        Op::of_edges(plan).contains(&self)
    }
}

/// t + F: DX/(P·DY) becomes DX·2^F/DY.
fn of_slope(plan: &Plan, _: &Channel) -> u32 {
    plan.widths().center_fraction + of_columns(plan, &plan.channels()[0])
}

/// F, 0 for an exact edge.
fn of_columns(plan: &Plan, _: &Channel) -> u32 {
    if plan.edge_kind == EdgeKind::Slope { plan.edge_fraction } else { 0 }
}

/// log2 K = t + r - e.
fn of_gradient(plan: &Plan, channel: &Channel) -> u32 {
    plan.widths().center_fraction + channel.fraction - channel.vertex_fraction
}

/// 2 t + r - e: DC/(P·DY) becomes DC·P·2^(r-e)/DY.
fn of_left_edge(plan: &Plan, channel: &Channel) -> u32 {
    plan.widths().center_fraction + of_gradient(plan, channel)
}

/// Edges of a triangle: major, first minor, second minor.
pub(super) const EDGES: usize = 3;

/// The edge of a lane in a round.
pub(super) fn edge_of(plan: &Plan, lane: usize, round: usize) -> Option<usize> {
    Some(lane + round * plan.lanes as usize).filter(|edge| *edge < EDGES)
}

/// The channel of a lane in a round.
pub(super) fn channel_of(plan: &Plan, lane: usize, round: usize) -> Option<Channel> {
    plan.planes().map(|(_, channel)| *channel).nth(lane + round * plan.lanes as usize)
}

/// Bits of the longest vertex value of all.
pub(super) fn longest_value(plan: &Plan) -> u32 {
    plan.planes().map(|(_, channel)| channel.vertex_bits()).max().unwrap_or(1)
}

/// The largest scale: differences and the area's sign are at most 2 to the bits of a value.
pub(super) fn most_scale(plan: &Plan) -> u32 {
    longest_value(plan) / 2 + 1
}

/// Clocks of a doubling operation, not scaled, in a round: those of the channel that needs the most.
pub(super) fn round_clocks(
    plan: &Plan,
    doublings: fn(&Plan, &Channel) -> u32,
    of_edge: bool,
    round: usize,
) -> u32 {
    if of_edge {
        return doublings(plan, &plan.channels()[0]).div_ceil(2);
    }
    let channels = (0..plan.lanes as usize).filter_map(|lane| channel_of(plan, lane, round));
    channels.map(|channel| doublings(plan, &channel).div_ceil(2)).max().unwrap_or(1)
}

/// Rounds in which the lanes do all edges, and all channels.
pub(super) fn rounds(plan: &Plan) -> [usize; 2] {
    [EDGES, plan.planes().count()].map(|jobs| jobs.div_ceil(plan.lanes as usize))
}
