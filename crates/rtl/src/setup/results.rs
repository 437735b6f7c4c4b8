//! What the lanes found, taken into the registers of the prim.

use edgewalk_machine::units::tokens::{EDGES, remainder_bits};
use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{Instance, Module, Reg, Signal};

use super::control::Control;
use super::schedule::Op;
use super::sort::Vertices;
use crate::wires::Registers;

/// The triangle's area, from the first lane's first product.
pub(super) struct Area<'m>(Reg<'m>);

impl<'m> Area<'m> {
    /// Takes |area| and its sign.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        control: &Control<'m>,
        lane: Instance<'m>,
        prim: &Registers<'m>,
    ) -> Area<'m> {
        m.comment("Twice the area of the triangle, and the side on which it lies.");
        let bits = 2 * plan.widths().difference;
        let product = lane.output("product").trunc(bits);
        // The product stands while the operation after it loads.
        let take = control.load_in(Op::EdgeStart, 0).named("take_area");
        let area = m.reg("area", bits - 1).doc("|du1 dv2 - du2 dv1|");
        area.when(take, product.msb().mux(-product, product).trunc(bits - 1));
        prim["major_right"].when(take, product.msb());
        Area(area)
    }

    /// |area|, unsigned.
    pub fn value(&self) -> Signal<'m> {
        self.0.q()
    }

    /// The triangle has none.
    pub fn is_zero(&self) -> Signal<'m> {
        !self.0.q().any()
    }
}

/// Where results come from and go to.
pub(super) struct Results<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub prim: &'a Registers<'m>,
}

impl<'m> Results<'_, 'm> {
    /// Takes all results of all lanes.
    pub fn take(&self, lanes: &[Instance<'m>]) {
        for edge in 0..3 {
            let job = edge + 1;
            self.edge(edge, job / lanes.len(), lanes[job % lanes.len()]);
        }
        for (job, channel) in self.plan.channels().iter().enumerate() {
            let (round, lane) = (job / lanes.len(), lanes[job % lanes.len()]);
            match self.plan.fill {
                Fill::Exact => self.channel_exact(channel, round, lane),
                Fill::Textbook => self.channel_textbook(channel, round, lane),
            }
        }
    }

    fn register(&self, name: &str, result: &str) -> Reg<'m> {
        self.prim[format!("{name}_{result}").as_str()]
    }

    fn edge(&self, edge: usize, round: usize, lane: Instance<'m>) {
        let name = EDGES[edge];
        self.m.comment(&format!("Edge: {name}."));
        let (columns, bits) = (self.plan.widths().column, remainder_bits(self.plan));
        let height = self.vertices.heights[edge];
        let t = self.plan.widths().center_fraction;
        let is_high =
            height.slice(height.width() - 1, t).any().named_doc(&format!("{name}_steps"), "DY >= P");
        let is_there = height.any().named_doc(&format!("{name}_is_there"), "DY > 0");
        let (q, f, c, r) = match self.plan.edge_kind {
            EdgeKind::Exact => {
                let quotient = lane.output("quotient").trunc(columns);
                let remainder = lane.output("remainder").trunc(bits);
                let (c, r) = match self.plan.fill {
                    // −E was divided: its remainder is that of m.
                    Fill::Exact => (-quotient, remainder),
                    // E was divided: m = −1 − floor(E/P).
                    Fill::Textbook => (quotient + 1, height + !remainder),
                };
                (quotient, remainder, c, r)
            }
            EdgeKind::Slope => {
                let rounded = lane.output("rounded").trunc(columns + bits);
                let m = match self.plan.fill {
                    Fill::Exact => -rounded,
                    Fill::Textbook => !rounded,
                };
                let whole = |of: Signal<'m>| of.slice(columns + bits - 1, bits);
                (whole(rounded), rounded.trunc(bits), -whole(m), m.trunc(bits))
            }
        };
        let (step, start) =
            (self.control.after_in(Op::EdgeStep, round), self.control.after_in(Op::EdgeStart, round));
        self.register(name, "q").when(step, is_high.mux(q, 0));
        self.register(name, "f").when(step, is_high.mux(f, 0));
        self.register(name, "c").when(start, is_there.mux(c, 0));
        self.register(name, "r").when(start, is_there.mux(r, 0));
    }

    /// Of vertex 0, or the one the left edge begins at: its value as a word, with the half that makes cutting a rounding if
    /// the channel is rounded.
    fn with_half(&self, channel: &Channel, value: Signal<'m>) -> Signal<'m> {
        let m = self.m;
        let (r, e) = (channel.fraction, channel.vertex_fraction);
        let zeros =
            |bits: u32, value: Signal<'m>| if bits == 0 { value } else { m.cat(&[value, m.lit(bits, 0)]) };
        match e {
            _ if r == 0 || !channel.kind.is_rounded() => zeros(r - e, value),
            0 => zeros(r - 1, m.cat(&[value, m.lit(1, 1)])),
            _ => zeros(r - e, value + (1 << (e - 1))),
        }
    }

    fn channel_exact(&self, channel: &Channel, round: usize, lane: Instance<'m>) {
        let name = channel.name;
        self.m.comment(&format!("Channel: {name}."));
        let word = |signal: Signal<'m>| signal.trunc(channel.word());
        let rounded = word(lane.output("rounded"));
        let after = |op: Op| self.control.after_in(op, round);
        self.register(name, "g").when(after(Op::Gx), self.prim["major_right"].q().mux(-rounded, rounded));
        self.register(name, "d0").when(after(Op::Line), rounded);
        self.register(name, "d1").when(after(Op::Start), word(lane.output("d1")));
        let top = self.with_half(channel, self.vertices.value(channel, 0));
        self.register(name, "start").when(after(Op::Start), rounded + top);
    }

    fn channel_textbook(&self, channel: &Channel, round: usize, lane: Instance<'m>) {
        let name = channel.name;
        self.m.comment(&format!("Channel: {name}."));
        let rounded = lane.output("rounded").trunc(channel.word());
        let after = |op: Op| self.control.after_in(op, round);
        self.register(name, "g").when(after(Op::Gx), rounded);
        // The left edge begins at vertex 1 only in part 2 of a triangle that lies left of its major edge.
        let value = |place: usize| self.with_half(channel, self.vertices.value(channel, place));
        let top_b = self.prim["major_right"].q().mux(value(1), value(0));
        let parts = [("start_a", Op::StartA, "n1", value(0)), ("start_b", Op::StartB, "n2", top_b)];
        for (start, op, lines, top) in parts {
            let used = self.prim[lines].q().any();
            self.register(name, start).when(after(op), used.mux(rounded + top, 0));
        }
        for (line, op, lines) in [("d_a", Op::LineA, "n1"), ("d_b", Op::LineB, "n2")] {
            let used = self.prim[lines].q().any();
            self.register(name, line).when(after(op), used.mux(rounded, 0));
        }
    }
}
