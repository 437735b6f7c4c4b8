//! What the lanes take in: differences of the vertices, whole numbers to add, and the moduli.

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::area::Area;
use super::control::Control;
use super::lane::modulus_bits;
use super::lanes::Lane;
use super::scale::Scale;
use super::sort::{ENDS, Vertices};
use super::steps::{Op, channel_of, edge_of, rounds};
use super::values::Values;
use super::walked::Walked;

/// Where it comes from.
pub(super) struct Sources<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub area: &'a Area<'m>,
    pub scale: &'a Scale<'m>,
    pub walked: &'a Walked<'m>,
    pub values: &'a Values<'m>,
}

impl<'m> Sources<'_, 'm> {
    /// Connects what a lane takes in, and gives the differences of values that it is shown.
    pub fn connect(&self, lane: &Lane<'m>) -> Signal<'m> {
        let (m, control) = (self.m, self.control);
        m.comment(&format!("Lane {}: what it takes in.", lane.number));
        let difference = self.difference(lane, lane.shape.number);
        let has_edge = self.has_edge(lane);
        let number =
            if has_edge { self.values.of_edge.mux(self.of_edge(lane), difference) } else { difference };
        let number = number.named_doc(&format!("number{}", lane.number), "signed");
        let kept = m.reg(&format!("kept{}", lane.number), number.width());
        let kept = kept.doc("a number that may not fit, or a first value; signed");
        let may_not_fit = if has_edge || self.plan.fill == Fill::Textbook {
            vec![Op::TakeDx, Op::TakeA, Op::TakeB]
        } else {
            Vec::new()
        };
        let first_values = [Op::SignStart, Op::DoubleStartA, Op::DoubleStartB];
        let kept =
            kept.when(control.way.next.one_of(&[&may_not_fit, &first_values[..]].concat()), number).q();
        let digits = if may_not_fit.is_empty() {
            m.lit(2, 0)
        } else {
            // In the first clock of a pause these are the sign; when two are left, the lowest.
            let pair = m.cat(&[control.pause.left - 2, m.lit(1, 0)]);
            kept.sar_by(pair).trunc(2)
        };
        let (modulus, short) = self.modulus(lane);
        lane.instance
            .connect("number", number)
            .connect("digits", digits)
            .connect("whole_in", self.whole(lane, kept))
            .connect("modulus_in", modulus)
            .connect("modulus_short", short);
        difference
    }

    /// The lane does edges.
    fn has_edge(&self, lane: &Lane<'m>) -> bool {
        edge_of(self.plan, lane.number, 0).is_some()
    }

    /// A number that was taken in is needed, by this lane, and does not fit: those of the area's modulus
    /// always do.
    pub fn unfit(&self, lane: &Lane<'m>) -> Option<Signal<'m>> {
        let unfit = lane.instance.output("unfit");
        match self.plan.fill {
            Fill::Exact if !self.has_edge(lane) => None,
            Fill::Exact if rounds(self.plan)[0] == 1 && lane.number == 0 => {
                Some(self.walked.edge(0).map_or(unfit, |walked| unfit & walked))
            }
            Fill::Exact => Some(unfit & self.edge_needed(lane)),
            Fill::Textbook => Some(unfit & self.needed(lane)),
        }
    }

    /// The edge of the round has lines.
    fn edge_needed(&self, lane: &Lane<'m>) -> Signal<'m> {
        let yes_or_no = |yes: bool| self.m.lit(1, yes.into());
        self.control.way.stepped.of_round(rounds(self.plan)[0], |round| {
            match edge_of(self.plan, lane.number, round) {
                Some(edge) => self.walked.edge(edge).unwrap_or_else(|| yes_or_no(true)),
                None => yes_or_no(false),
            }
        })
    }

    /// Textbook fill, where values of the left edges may be too long as well.
    fn needed(&self, lane: &Lane<'m>) -> Signal<'m> {
        let stepped = &self.control.way.stepped;
        let channel = stepped.of_round(rounds(self.plan)[1], |round| {
            self.m.lit(1, channel_of(self.plan, lane.number, round).is_some().into())
        });
        let part = |take: Op, part: usize| stepped.is(take) & self.walked.part(part);
        let parts = part(Op::TakeA, 0) | part(Op::TakeB, 1);
        (stepped.is(Op::TakeDx) & self.edge_needed(lane)) | (parts & channel)
    }

    /// The right side is that of the major edge.
    fn right(&self) -> Signal<'m> {
        self.area.negative
    }

    /// DX or DY of the lane's edge.
    fn of_edge(&self, lane: &Lane<'m>) -> Signal<'m> {
        let (next, bits) = (&self.control.way.next, lane.shape.number);
        let edge_rounds = rounds(self.plan)[0];
        let dw = self.plan.widths().difference;
        let of_edge = |value: &dyn Fn(usize) -> Signal<'m>| {
            next.of_round(edge_rounds, |round| {
                value(edge_of(self.plan, lane.number, round).unwrap_or(0)).sext(bits)
            })
        };
        let height = of_edge(&|edge| self.vertices.heights[edge].zext(dw));
        self.values.height.mux(height, of_edge(&|edge| self.vertices.across[edge]))
    }

    /// The difference of a channel's values at two vertices; of a single one its rounding is taken off.
    fn difference(&self, lane: &Lane<'m>, bits: u32) -> Signal<'m> {
        let (m, values) = (self.m, self.values);
        let of_round = |of: &dyn Fn(&Channel) -> Signal<'m>| {
            let of = |round: usize| {
                channel_of(self.plan, lane.number, round).map_or(m.lit(bits, 0), |channel| of(&channel))
            };
            let others = values.rounds.iter().enumerate();
            others.fold(of(0), |chosen, (i, is)| is.mux(of(i + 1), chosen))
        };
        let at = [0, 1, 2].map(|vertex| {
            of_round(&|channel| {
                let value = self.vertices.value(channel, vertex);
                if channel.kind.is_signed() { value.sext(bits) } else { value.zext(bits) }
            })
        });
        let pick = |vertex: Signal<'m>| vertex.bit(1).mux(at[2], vertex.bit(0).mux(at[1], at[0]));
        let rounding = of_round(&|channel| match half(channel) {
            Half::Within(bit) => m.lit(bits, (1 << bits) - (1 << bit)), // less 2^bit
            Half::Behind | Half::None => m.lit(bits, 0),
        });
        pick(values.to) - values.single.mux(rounding, pick(values.from))
    }

    /// The whole number that is added to a result: to a column those of the upper end, to a first value that
    /// at its vertex.
    fn whole(&self, lane: &Lane<'m>, kept: Signal<'m>) -> Signal<'m> {
        let (m, rest, bits) = (self.m, &self.control.way.rest, lane.shape.whole);
        let [edge_rounds, channel_rounds] = rounds(self.plan);
        let t = self.plan.widths().center_fraction;
        let column = |place: usize| {
            let u = self.vertices.u(place);
            let column = u.slice(u.width() - 1, t);
            match self.plan.edge_kind {
                EdgeKind::Exact => fit(column, bits),
                EdgeKind::Slope => fit(m.cat(&[column, m.lit(self.plan.edge_fraction, 0)]), bits),
            }
        };
        let channel = rest.of_round(channel_rounds, |round| {
            let channel = channel_of(self.plan, lane.number, round);
            channel.map_or(m.lit(bits, 0), |channel| self.first_value(&channel, kept, bits))
        });
        let starts = rest.one_of(&[Op::SumStart, Op::DoubleStartA, Op::DoubleStartB]);
        let of_channel = starts.mux(channel, 0);
        if !self.has_edge(lane) {
            return of_channel;
        }
        let edge = rest.of_round(edge_rounds, |round| {
            column(ENDS[edge_of(self.plan, lane.number, round).unwrap_or(0)].0)
        });
        rest.is(Op::of_column(self.plan)).mux(edge, of_channel)
    }

    /// The value the first one is counted from, as a word, with the halves that make cutting a rounding.
    fn first_value(&self, channel: &Channel, value: Signal<'m>, bits: u32) -> Signal<'m> {
        let (m, t) = (self.m, self.plan.widths().center_fraction);
        let mut below = channel.fraction - channel.vertex_fraction;
        let mut value = value;
        if let Half::Behind = half(channel) {
            (value, below) = (m.cat(&[value, m.lit(1, 1)]), below - 1);
        }
        if below > 0 {
            value = m.cat(&[value, m.lit(below, 0)]);
        }
        match self.plan.fill {
            Fill::Exact => fit(m.cat(&[value, m.lit(t, 1 << (t - 1))]), bits),
            Fill::Textbook => fit(value, bits),
        }
    }

    /// -M - 1 of an edge, P·DY; of the channels the scaled area's.
    fn modulus(&self, lane: &Lane<'m>) -> (Signal<'m>, Signal<'m>) {
        let (m, named) = (self.m, &self.control.way.named);
        let (t, bits) = (self.plan.widths().center_fraction, modulus_bits(self.plan));
        let height = |edge: usize| !m.cat(&[self.vertices.heights[edge], m.lit(t, 0)]).zext(bits);
        let edge = named.of_round(rounds(self.plan)[0], |round| {
            height(edge_of(self.plan, lane.number, round).unwrap_or(0))
        });
        let right = self.right();
        if self.plan.fill == Fill::Exact && !self.has_edge(lane) {
            return (self.scale.modulus, !right);
        }
        let of_area = named.is(Op::Take12);
        let mut modulus = of_area.mux(self.scale.modulus, edge);
        if self.plan.fill == Fill::Textbook {
            modulus = named.is(Op::TakeA).mux(right.mux(height(1), height(0)), modulus);
            modulus = named.is(Op::TakeB).mux(right.mux(height(2), height(0)), modulus);
        }
        (modulus, !(of_area & right))
    }
}

/// The low bits of a signed number, or as many more of its sign.
pub(super) fn fit(value: Signal<'_>, bits: u32) -> Signal<'_> {
    if value.width() >= bits { value.trunc(bits) } else { value.sext(bits) }
}

/// Where the half that makes cutting a rounding lies in a vertex value.
enum Half {
    /// The channel is cut as it is.
    None,
    /// Just behind its last bit.
    Behind,
    /// The value of this bit.
    Within(u32),
}

fn half(channel: &Channel) -> Half {
    match channel.vertex_fraction {
        _ if channel.fraction == 0 || !channel.kind.is_rounded() => Half::None,
        0 => Half::Behind,
        e => Half::Within(e - 1),
    }
}
