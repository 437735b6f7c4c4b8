//! What the lanes found, taken into the registers of the prim.

use edgewalk_machine::units::tokens::EDGES;
use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use super::control::Control;
use super::lanes::Lane;
use super::sort::Vertices;
use super::steps::{EDGES as ALL_EDGES, Op, rounds};
use super::walked::Walked;
use crate::wires::Registers;

/// Where results come from and go to.
pub(super) struct Results<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub prim: &'a Registers<'m>,
    pub walked: &'a Walked<'m>,
}

impl<'m> Results<'_, 'm> {
    /// Takes all results of all lanes.
    pub fn take(&self, lanes: &[Lane<'m>]) {
        for edge in 0..ALL_EDGES {
            self.left_out(edge);
            let (round, lane) = (edge / lanes.len(), &lanes[edge % lanes.len()]);
            match self.plan.edge_kind {
                EdgeKind::Exact => self.edge_exact(edge, round, lane),
                EdgeKind::Slope => self.edge_slope(edge, round, lane),
            }
        }
        for (job, channel) in self.plan.planes().map(|(_, channel)| channel).enumerate() {
            let (round, lane) = (job / lanes.len(), &lanes[job % lanes.len()]);
            match self.plan.fill {
                Fill::Exact => self.channel_exact(channel, round, lane),
                Fill::Textbook => self.channel_textbook(channel, round, lane),
            }
        }
    }

    fn register(&self, name: &str, result: &str) -> Reg<'m> {
        self.prim[format!("{name}_{result}").as_str()]
    }

    /// The edge steps: its part has lines, and it is a pixel high at least.
    fn steps(&self, edge: usize) -> Signal<'m> {
        let height = self.vertices.heights[edge];
        let high = height.slice(height.width() - 1, self.plan.widths().center_fraction).any();
        self.walked.edge(edge).map_or(high, |walked| walked & high)
    }

    /// With POLY: an edge of a round that is left out is 0; a slope is not written where no side counts.
    fn left_out(&self, edge: usize) {
        let leaves_out = rounds(self.plan)[0] > 1 || self.plan.edge_kind == EdgeKind::Slope;
        if self.plan.polygon.is_there() && leaves_out {
            for result in ["c", "dist", "q", "f"] {
                self.register(EDGES[edge], result).when(self.begins(), 0);
            }
        }
    }

    /// The token's first operation ends: results of the token before, or of one that a reset cut off, are all written.
    fn begins(&self) -> Signal<'m> {
        self.control.way.whole.is(Op::Subtract)
    }

    fn edge_exact(&self, edge: usize, round: usize, lane: &Lane<'m>) {
        let (m, name) = (self.m, EDGES[edge]);
        m.comment(&format!("Edge: {name}."));
        let t = self.plan.widths().center_fraction;
        let (rest, value) = (lane.instance.output("rest_out"), lane.instance.output("value"));
        let (steps, height) = (self.steps(edge), self.vertices.heights[edge]);
        let (f, q) = (self.register(name, "f"), self.register(name, "q"));
        let after =
            |op: Op| (self.control.way.rest.ends_in(op, round), self.control.way.whole.ends_in(op, round));
        let (rest_now, whole_now) = after(Op::DoubleDx);
        f.when(rest_now, steps.mux(rest.slice(rest.width() - 1, t).trunc(f.q().width()), 0));
        q.when(whole_now, steps.mux(value.trunc(q.q().width()), 0));
        let (r, c) = (self.register(name, "dist"), self.register(name, "c"));
        let (rest_now, whole_now) = after(Op::Sum);
        let walked = |value: Signal<'m>| self.walked.edge(edge).map_or(value, |walked| walked.mux(value, 0));
        let (onward, column) = match self.plan.fill {
            // From the edge on to the next whole column: M less the rest, where there is one.
            Fill::Exact => {
                let onward = m.cat(&[height, m.lit(t, 0)]) - rest.trunc(height.width() + t);
                let onward = rest.any().mux(onward.slice(onward.width() - 1, t), 0);
                (onward, value)
            }
            // And one further where it is whole.
            Fill::Textbook => (height + !rest.slice(height.width() + t - 1, t), value + 1),
        };
        r.when(rest_now, walked(onward.trunc(r.q().width())));
        c.when(whole_now, walked(column.trunc(c.q().width())));
    }

    fn edge_slope(&self, edge: usize, round: usize, lane: &Lane<'m>) {
        let name = EDGES[edge];
        self.m.comment(&format!("Edge: {name}."));
        let (columns, bits) = (self.plan.widths().column, self.plan.edge_fraction);
        let rounded = lane.instance.output("value").trunc(columns + bits);
        let steps = self.steps(edge);
        let slope = self.control.way.whole.ends_in(Op::DoubleDx, round);
        let whole = |of: Signal<'m>| of.slice(columns + bits - 1, bits);
        self.register(name, "q").when(slope, steps.mux(whole(rounded), 0));
        self.register(name, "f").when(slope, steps.mux(rounded.trunc(bits), 0));
        let distance = match self.plan.fill {
            Fill::Exact => -rounded,
            Fill::Textbook => !rounded,
        };
        let start = self.control.way.whole.ends_in(Op::DoubleColumns, round);
        let walked = |value: Signal<'m>| self.walked.edge(edge).map_or(value, |walked| walked.mux(value, 0));
        self.register(name, "c").when(start, walked(-whole(distance)));
        self.register(name, "dist").when(start, walked(distance.trunc(bits)));
    }

    fn channel_exact(&self, channel: &Channel, round: usize, lane: &Lane<'m>) {
        let name = channel.name;
        self.m.comment(&format!("Channel: {name}."));
        let value = lane.instance.output("value");
        let rounded = value.trunc(channel.word());
        let t = self.plan.widths().center_fraction;
        let start = value.slice(channel.word() + t - 1, t);
        let (whole, register) = (&self.control.way.whole, |result| self.register(name, result));
        if self.plan.polygon.is_there() {
            // What has no values keeps these.
            for result in ["g", "d0", "start"] {
                register(result).when(self.begins(), 0);
            }
        }
        register("g").when(whole.ends_in(Op::DoubleX, round), rounded); // negated where the spans run left
        register("d0").when(whole.ends_in(Op::DoubleLine, round), rounded);
        if !self.plan.polygon.is_there() {
            register("d1").when(whole.ends_in(Op::AddX, round), rounded);
        }
        // What is taken before it is done is taken again.
        register("start").when(whole.is_in(Op::SumStart, round), start);
    }

    fn channel_textbook(&self, channel: &Channel, round: usize, lane: &Lane<'m>) {
        let name = channel.name;
        self.m.comment(&format!("Channel: {name}."));
        let rounded = lane.instance.output("value").trunc(channel.word());
        let after = |op: Op| self.control.way.whole.ends_in(op, round);
        self.register(name, "g").when(after(Op::DoubleX), rounded);
        let results = [
            ("d_a", Op::DoubleA, 0),
            ("start_a", Op::DoubleStartA, 0),
            ("d_b", Op::DoubleB, 1),
            ("start_b", Op::DoubleStartB, 1),
        ];
        for (result, op, part) in results {
            let used = self.walked.part(part);
            self.register(name, result).when(after(op), used.mux(rounded, 0));
        }
    }
}
