//! What SETUP does in which order: the operations of a round, and the steps of the lanes they are made of.

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};

/// A step of a lane (`docs/machine.md`, section 2). Bit 4 of its number says that the addend is a stored pair, bit 3 that M is taken
/// off, bit 2 that M is added if a sign says so, which one bit 0: the lane reads them off where time is short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Nothing.
    Rest = 0,
    /// A number is taken in.
    Load = 0b1,
    /// A number that does not fit, its sign: M - 1 or 0 of the rest.
    Less1 = 0b10,
    /// Doubled.
    Double1 = 0b11,
    /// M is added to a number that was taken in, if it is below 0; does it fit?
    Fix = 0b100,
    /// A number that does not fit, its sign first: M or 0 of the rest.
    Begin = 0b101,
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
    /// A whole number is added; the rest stays, whatever its addend.
    Whole = 0b1_0100,
}

impl Step {
    /// Bits of its number.
    pub const BITS: u32 = 5;
}

/// An operation of all lanes: one step, or as many as its numbers have digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    /// DX of an edge.
    LoadDx,
    FixDx,
    /// q and f.
    DoubleDx,
    /// DY.
    LoadDy,
    AddDx,
    WaitDx,
    /// N of an edge, without whole columns.
    Sum,
    /// Whole columns of the upper end: C and R of an exact edge.
    Columns,
    /// C and R of a slope edge.
    DoubleColumns,
    RoundColumns,
    /// dc1 of a channel.
    Load1,
    Fix1,
    /// -dc2.
    Load2,
    Fix2,
    /// p1 + p2.
    Add12,
    Wait,
    /// gx.
    SumX,
    DoubleX,
    /// gy.
    SignY,
    SumY,
    DoubleY,
    /// gx + gy.
    AddX,
    /// q gx, and gy: d0.
    SignLine,
    SumLine,
    AddY,
    /// d1.
    AddLine,
    /// start.
    SignStart,
    SumStart,
    AddStart,
    /// Part 1 of textbook fill: another modulus, then DC.
    SetA,
    LoadA,
    FixA,
    /// dA.
    DoubleA,
    WaitA,
    /// startA.
    SumA,
    DoubleStartA,
    AddA,
    RoundA,
    /// Part 2.
    SetB,
    LoadB,
    FixB,
    /// dB.
    DoubleB,
    WaitB,
    /// startB.
    SumB,
    DoubleStartB,
    AddB,
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
    /// The operations on each edge, in their order.
    pub fn of_edges(plan: &Plan) -> &'static [Op] {
        use Op::*;
        match plan.edge_kind {
            EdgeKind::Exact => &[LoadDx, FixDx, DoubleDx, LoadDy, AddDx, WaitDx, Sum, Columns],
            EdgeKind::Slope => {
                &[LoadDx, FixDx, DoubleDx, LoadDy, AddDx, WaitDx, Sum, Columns, DoubleColumns, RoundColumns]
            }
        }
    }

    /// The operations on each channel, in their order.
    pub fn of_channels(plan: &Plan) -> &'static [Op] {
        use Op::*;
        match plan.fill {
            Fill::Exact => &[
                Load1, Fix1, Load2, Fix2, Add12, Wait, SumX, DoubleX, SignY, SumY, DoubleY, AddX, SignLine,
                SumLine, AddY, AddLine, SignStart, SumStart, AddStart,
            ],
            Fill::Textbook => &[
                Load1,
                Fix1,
                Load2,
                Fix2,
                Add12,
                Wait,
                SumX,
                DoubleX,
                SetA,
                LoadA,
                FixA,
                DoubleA,
                WaitA,
                SumA,
                DoubleStartA,
                AddA,
                RoundA,
                SetB,
                LoadB,
                FixB,
                DoubleB,
                WaitB,
                SumB,
                DoubleStartB,
                AddB,
                RoundB,
            ],
        }
    }

    /// What it does.
    pub fn doing(self) -> Doing {
        use Op::*;
        let (step, length, slot, result) = match self {
            LoadDx | Load1 | Load2 | LoadA | LoadB => (Step::Load, Length::Clocks(1), 0, None),
            LoadDy => (Step::Load, Length::Clocks(1), 0, Some(1)),
            FixDx | Fix2 => (Step::Fix, Length::Clocks(1), 0, Some(2)),
            Fix1 | FixA | FixB => (Step::Fix, Length::Clocks(1), 0, Some(1)),
            DoubleDx => (Step::Double2, Length::Doublings(of_slope), 0, None),
            DoubleColumns => (Step::Double2, Length::Doublings(of_columns), 0, None),
            AddDx => (Step::Add, Length::Clocks(1), 2, Some(3)),
            Add12 => (Step::Add, Length::Clocks(1), 1, Some(3)),
            WaitDx | Wait => (Step::Rest, Length::Clocks(2), 0, None),
            RoundColumns | SetA | WaitA | RoundA | SetB | WaitB | RoundB => {
                (Step::Rest, Length::Clocks(1), 0, None)
            }
            Sum | SumX | SumA | SumB => (Step::First, Length::Digits, 0, None),
            Columns | AddStart | AddA | AddB => (Step::Whole, Length::Clocks(1), 0, None),
            DoubleX => (Step::Double2, Length::Scaled(of_gradient), 0, Some(5)),
            DoubleY => (Step::Double2, Length::Scaled(of_gradient), 0, Some(6)),
            DoubleStartA | DoubleStartB => (Step::Double2, Length::Doublings(of_gradient), 0, None),
            DoubleA | DoubleB => (Step::Double2, Length::Doublings(of_left_edge), 0, None),
            SignY => (Step::Sign, Length::Clocks(1), 0, None),
            SignLine | SignStart => (Step::Sign, Length::Clocks(1), 4, None),
            SumY => (Step::Next, Length::Digits, 0, None),
            SumLine | SumStart => (Step::Next, Length::Digits, 4, None),
            AddX => (Step::Add, Length::Clocks(1), 5, Some(7)),
            AddY => (Step::Add, Length::Clocks(1), 6, None),
            AddLine => (Step::Add, Length::Clocks(1), 5, None),
        };
        Doing { step, length, slot, result }
    }

    /// It is one of those on edges.
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
    plan.channels().get(lane + round * plan.lanes as usize).copied()
}

/// Bits of the longest vertex value of all.
pub(super) fn longest_value(plan: &Plan) -> u32 {
    plan.channels().iter().map(|channel| channel.vertex_bits()).max().unwrap_or(1)
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
    [EDGES, plan.channels().len()].map(|jobs| jobs.div_ceil(plan.lanes as usize))
}
