//! What the lanes take in: differences of the vertices, whole numbers to add, and the moduli.

use edgewalk_machine::{Channel, Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::area::Area;
use super::control::Control;
use super::lanes::Lane;
use super::sort::{ENDS, Vertices};
use super::steps::{Op, channel_of, edge_of, rounds};
use crate::wires::Registers;

/// Where it comes from.
pub(super) struct Sources<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub area: &'a Area<'m>,
    pub prim: &'a Registers<'m>,
}

impl<'m> Sources<'_, 'm> {
    /// Connects what a lane takes in.
    pub fn connect(&self, lane: &Lane<'m>) {
        let (m, control) = (self.m, self.control);
        m.comment(&format!("Lane {}: what it takes in.", lane.number));
        let number = self.number(lane).named_doc(&format!("number{}", lane.number), "signed");
        // When three clocks or more are left the digits are not read; when two, the lowest.
        let pair = m.cat(&[control.pause - 2, m.lit(1, 0)]);
        let digits = number.sext(number.width() + 1).sar_by(pair).trunc(2);
        let (modulus, short) = self.modulus(lane);
        lane.instance
            .connect("number", number)
            .connect("digits", digits)
            .connect("whole_in", self.whole(lane))
            .connect("modulus_in", modulus)
            .connect("modulus_short", short);
    }

    /// A number that was taken in is needed, by this lane.
    pub fn needed(&self, lane: &Lane<'m>) -> Signal<'m> {
        let (m, stepped) = (self.m, &self.control.stepped);
        let yes_or_no = |yes: bool| m.lit(1, yes.into());
        let [edge_rounds, channel_rounds] = rounds(self.plan);
        let edge = stepped.of_round(edge_rounds, |round| match edge_of(self.plan, lane.number, round) {
            Some(0) => yes_or_no(true),
            Some(1) => self.lines("n1"),
            Some(_) => self.lines("n2"),
            None => yes_or_no(false),
        });
        let channel = stepped
            .of_round(channel_rounds, |round| yes_or_no(channel_of(self.plan, lane.number, round).is_some()));
        let part = |fix: Op, lines: &str| !stepped.is(fix) | self.lines(lines);
        let channel = channel & part(Op::FixA, "n1") & part(Op::FixB, "n2");
        stepped.is(Op::FixDx).mux(edge, channel)
    }

    fn lines(&self, part: &str) -> Signal<'m> {
        self.prim[part].q().any()
    }

    /// The right side is that of the major edge.
    fn right(&self) -> Signal<'m> {
        self.area.negative
    }

    fn number(&self, lane: &Lane<'m>) -> Signal<'m> {
        let (m, formed, bits) = (self.m, &self.control.formed, lane.shape.number);
        let [edge_rounds, channel_rounds] = rounds(self.plan);
        let u = |place: usize| self.vertices.u(place);
        let dw = self.plan.widths().difference;
        let dx = |edge: usize| match edge {
            0 => self.vertices.du2,
            1 => self.vertices.du1,
            _ => u(2).sext(dw) - u(1).sext(dw),
        };
        let of_edge = |value: &dyn Fn(usize) -> Signal<'m>| {
            formed.of_round(edge_rounds, |round| {
                value(edge_of(self.plan, lane.number, round).unwrap_or(0)).sext(bits)
            })
        };
        let edge =
            formed.is(Op::LoadDy).mux(of_edge(&|edge| self.vertices.heights[edge].zext(dw)), of_edge(&dx));
        let channel = formed.of_round(channel_rounds, |round| {
            channel_of(self.plan, lane.number, round)
                .map_or(m.lit(bits, 0), |channel| self.difference(&channel, bits))
        });
        formed.one_of(&[Op::LoadDx, Op::FixDx, Op::LoadDy]).mux(edge, channel)
    }

    /// dc1 and -dc2, both as the area has its sign; textbook fill: of the ends of the left edges too.
    fn difference(&self, channel: &Channel, bits: u32) -> Signal<'m> {
        let formed = &self.control.formed;
        let value = |place: usize| {
            let value = self.vertices.value(channel, place);
            if channel.kind.is_signed() { value.sext(bits) } else { value.zext(bits) }
        };
        let right = self.right();
        let second = formed.one_of(&[Op::Load2, Op::Fix2]);
        // dc1 = c1 - c0, -dc2 = c0 - c2, the other way round where the area is below 0.
        let mut from = second.mux(right.mux(value(0), value(2)), right.mux(value(1), value(0)));
        let mut to = second.mux(right.mux(value(2), value(0)), right.mux(value(0), value(1)));
        if self.plan.fill == Fill::Textbook {
            // The left edge is the major one, or that of the part.
            let (a, b) = (formed.one_of(&[Op::LoadA, Op::FixA]), formed.one_of(&[Op::LoadB, Op::FixB]));
            from = (a | b).mux((b & right).mux(value(1), value(0)), from);
            to = (a | b).mux((a & right).mux(value(1), value(2)), to);
        }
        to - from
    }

    fn whole(&self, lane: &Lane<'m>) -> Signal<'m> {
        let (stepped, bits) = (&self.control.stepped, lane.shape.whole);
        let [edge_rounds, channel_rounds] = rounds(self.plan);
        let t = self.plan.widths().center_fraction;
        let column = |place: usize| {
            let u = self.vertices.u(place);
            fit(u.slice(u.width() - 1, t), bits)
        };
        let edge = stepped.of_round(edge_rounds, |round| {
            column(ENDS[edge_of(self.plan, lane.number, round).unwrap_or(0)].0)
        });
        let channel = stepped.of_round(channel_rounds, |round| {
            let channel = channel_of(self.plan, lane.number, round);
            channel.map_or(self.m.lit(bits, 0), |channel| self.first_value(&channel, bits))
        });
        stepped.is(Op::Columns).mux(edge, channel)
    }

    /// The value the first one is counted from, with the halves that make cutting a rounding.
    fn first_value(&self, channel: &Channel, bits: u32) -> Signal<'m> {
        let (m, t) = (self.m, self.plan.widths().center_fraction);
        let from = |place: usize| {
            let value = self.with_half(channel, self.vertices.value(channel, place));
            if channel.kind.is_signed() { fit(value, bits) } else { fit(m.cat(&[m.lit(1, 0), value]), bits) }
        };
        match self.plan.fill {
            Fill::Exact => {
                let half = m.lit(t, 1 << (t - 1));
                fit(m.cat(&[from(0), half]), bits)
            }
            Fill::Textbook => {
                let b = self.control.stepped.is(Op::AddB);
                (b & self.right()).mux(from(1), from(0))
            }
        }
    }

    /// A vertex value as a word, with the half that makes cutting a rounding if the channel is rounded.
    fn with_half(&self, channel: &Channel, value: Signal<'m>) -> Signal<'m> {
        let m = self.m;
        let (r, e) = (channel.fraction, channel.vertex_fraction);
        let zeros =
            |bits: u32, value: Signal<'m>| if bits == 0 { value } else { m.cat(&[value, m.lit(bits, 0)]) };
        match e {
            _ if r == 0 || !channel.kind.is_rounded() => zeros(r - e, value),
            0 => zeros(r - 1, m.cat(&[value, m.lit(1, 1)])),
            _ => zeros(r - e, fit(value, channel.word()) + (1 << (e - 1))),
        }
    }

    /// -M - 1 of an edge, P·DY; of the channels -A, or -A - 1 where the area is above 0.
    fn modulus(&self, lane: &Lane<'m>) -> (Signal<'m>, Signal<'m>) {
        let (m, formed) = (self.m, &self.control.formed);
        let (t, bits) = (self.plan.widths().center_fraction, self.area.signed.width());
        let height = |edge: usize| !m.cat(&[self.vertices.heights[edge], m.lit(t, 0)]).zext(bits);
        let edge = formed.of_round(rounds(self.plan)[0], |round| {
            height(edge_of(self.plan, lane.number, round).unwrap_or(0))
        });
        let right = self.right();
        let area = right.mux(self.area.signed, !self.area.signed);
        let mut modulus = formed.is(Op::Load1).mux(area, edge);
        if self.plan.fill == Fill::Textbook {
            modulus = formed.is(Op::LoadA).mux(right.mux(height(1), height(0)), modulus);
            modulus = formed.is(Op::LoadB).mux(right.mux(height(2), height(0)), modulus);
        }
        (modulus, !(formed.is(Op::Load1) & right))
    }
}

/// The low bits of a signed number, or as many more of its sign.
fn fit(value: Signal<'_>, bits: u32) -> Signal<'_> {
    if value.width() >= bits { value.trunc(bits) } else { value.sext(bits) }
}
