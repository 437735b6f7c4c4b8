//! What the lanes multiply and divide in each operation.

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{Module, Signal};

use super::control::Control;
use super::lanes::Lane;
use super::lines::Lines;
use super::schedule::Op;
use super::sort::{ENDS, Vertices};
use crate::wires::Registers;

/// What operands are made of.
pub(super) struct Sources<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub lines: &'a Lines<'m>,
    pub prim: &'a Registers<'m>,
    /// |area|, unsigned.
    pub area: Signal<'m>,
}

/// The operands of the operations on channels that all lanes share.
pub(super) struct Shared<'m> {
    a: Signal<'m>,
    b: Signal<'m>,
    divisor: Signal<'m>,
    /// The differences of channels change their signs.
    flip: Signal<'m>,
}

impl<'m> Sources<'_, 'm> {
    fn major_right(&self) -> Signal<'m> {
        self.prim["major_right"].q()
    }

    fn during(&self, ops: &[Op]) -> Signal<'m> {
        self.control.during(ops)
    }

    /// How far the centres of a line lie below a vertex: line·P − v, signed, DW bits.
    fn below(&self, line: Signal<'m>, v: Signal<'m>) -> Signal<'m> {
        let w = self.plan.widths();
        self.m.cat(&[line, self.m.lit(w.center_fraction, 0)]) - v.sext(w.difference)
    }

    /// In exact fill C is a ceiling: setup divides −E.
    fn negates(&self) -> bool {
        self.plan.fill == Fill::Exact && self.plan.edge_kind == EdgeKind::Exact
    }

    /// What all lanes share.
    pub fn shared(&self) -> Shared<'m> {
        self.m.comment("Factors and divisor of the operations on channels, the same for all lanes.");
        let (a, b, divisor) = match self.plan.fill {
            Fill::Exact => self.shared_exact(),
            Fill::Textbook => self.shared_textbook(),
        };
        // Nx = σ(dc1·dv2 − dc2·dv1); Ny = σ(dc2·du1 − dc1·du2), its terms in the same places.
        let flip = match self.plan.fill {
            Fill::Exact => self.major_right() ^ self.during(&[Op::Ny]),
            Fill::Textbook => self.major_right(),
        };
        Shared {
            a: a.named_doc("channel_a", "signed"),
            b: b.named_doc("channel_b", "signed"),
            divisor,
            flip: flip.named_doc("flip", "differences of channels the other way round"),
        }
    }

    fn shared_exact(&self) -> (Signal<'m>, Signal<'m>, Signal<'m>) {
        let (m, v, dw) = (self.m, self.vertices, self.plan.widths().difference);
        let (t, major_right) = (self.plan.widths().center_fraction, self.major_right());
        let column = self.prim["major_c"].q() - major_right.zext(self.plan.widths().column);
        let column = column.named_doc("px", "column of the first pixel, signed");
        let right = m.cat(&[column, m.lit(t, 0)]) - v.u(0).sext(dw);
        let a = self.during(&[Op::Nx]).mux(v.heights[0].zext(dw), v.du2);
        let a = self.during(&[Op::LineProduct]).mux(self.prim["major_q"].q().sext(dw), a);
        let a = self.during(&[Op::StartProduct]).mux(right, a);
        let b = self.during(&[Op::Nx]).mux(v.heights[1].zext(dw), v.du1);
        let b = self.during(&[Op::LineProduct]).mux(1, b);
        let b = self.during(&[Op::StartProduct]).mux(self.below(self.lines.jm, v.v(0)), b);
        (a, b, self.area)
    }

    fn shared_textbook(&self) -> (Signal<'m>, Signal<'m>, Signal<'m>) {
        let (v, dw, major_right) = (self.vertices, self.plan.widths().difference, self.major_right());
        let in_b = self.during(&[Op::ProductB, Op::StartB, Op::LineB]).named_doc("in_b", "part 2");
        let line = in_b.mux(self.lines.j1, self.lines.j0);
        let top = (in_b & major_right).mux(v.v(1), v.v(0));
        let is_nx = self.during(&[Op::Nx]);
        let a = is_nx.mux(v.heights[0].zext(dw), 0);
        let b = is_nx.mux(v.heights[1].zext(dw), self.below(line, top));
        let minor = in_b.mux(v.heights[2], v.heights[1]);
        let height = major_right.mux(minor, v.heights[0]).zext(self.area.width());
        (a, b, self.during(&[Op::Gx]).mux(self.area, height).trunc(2 * dw - 1))
    }

    /// Connects the operands of a lane.
    pub fn connect(&self, lane: &Lane<'m>, shared: &Shared<'m>) {
        let (control, jobs, channels) = (self.control, &lane.edges, &lane.channels);
        let edge = |of: &dyn Fn(usize) -> Signal<'m>| control.of_round(jobs.len(), |round| of(jobs[round]));
        let shape = &lane.shape;
        let edges = self.control.in_edges;
        let name = |what: &str| format!("lane{}_{what}", lane.number);
        let [x_edge, y_edge] = [(0, "x_edge"), (1, "y_edge")]
            .map(|(term, what)| edge(&|job| self.edge_terms(job, shape.terms)[term]).named(&name(what)));
        let [x_channel, y_channel] = [(0, "x_channel"), (1, "y_channel")].map(|(term, what)| {
            let term_of = |round: usize| self.channel_terms(&channels[round], shape.terms, shared)[term];
            control.of_round(channels.len(), term_of).named(&name(what))
        });
        let [a_edge, b_edge] = [0, 1].map(|factor| edge(&|job| self.edge_factors(job)[factor]));
        let divisor = edge(&|job| self.edge_divisor(job, shape.divisor));
        lane.instance
            .connect("x_in", edges.mux(x_edge, x_channel))
            .connect("y_in", edges.mux(y_edge, y_channel))
            .connect("a_in", edges.mux(a_edge, shared.a))
            .connect("b_in", edges.mux(b_edge, shared.b))
            .connect("divisor_in", edges.mux(divisor, shared.divisor));
        lane.ask_results(self.plan);
    }

    /// Factors of the area (job 0), or of E of an edge.
    fn edge_factors(&self, job: usize) -> [Signal<'m>; 2] {
        let (v, dw) = (self.vertices, self.plan.widths().difference);
        let Some(edge) = job.checked_sub(1) else {
            return [v.heights[0].zext(dw), v.heights[1].zext(dw)];
        };
        let (from, line) = (ENDS[edge].0, [self.lines.jm, self.lines.j0, self.lines.j1][edge]);
        let u = v.u(from);
        let a = match self.plan.fill {
            Fill::Exact => u,
            // u + o: u = 2x is even.
            Fill::Textbook => self.m.cat(&[u.slice(u.width() - 1, 1), self.m.lit(1, 1)]),
        };
        [a.sext(dw), self.below(line, v.v(from))]
    }

    /// Terms of the area: du1, −du2; of E: DY, DX, or of −E their negatives.
    fn edge_terms(&self, job: usize, bits: u32) -> [Signal<'m>; 2] {
        let v = self.vertices;
        let less = |a: Signal<'m>, b: Signal<'m>| a.sext(bits) - b.sext(bits);
        let Some(edge) = job.checked_sub(1) else {
            return [less(v.u(1), v.u(0)), less(v.u(0), v.u(2))];
        };
        let (from, to) = ENDS[edge];
        if !self.negates() {
            return [less(v.v(to), v.v(from)), less(v.u(to), v.u(from))];
        }
        // The step of the edge divides DX itself, at the same input.
        let step = self.during(&[Op::EdgeStep]);
        let (first, second) = (step.mux(v.u(to), v.u(from)), step.mux(v.u(from), v.u(to)));
        [less(v.v(from), v.v(to)), less(first, second)]
    }

    fn edge_divisor(&self, job: usize, bits: u32) -> Signal<'m> {
        let height = self.vertices.heights[job.saturating_sub(1)].zext(bits);
        match self.plan.edge_kind {
            EdgeKind::Exact => height,
            EdgeKind::Slope => {
                self.during(&[Op::EdgeStart]).mux(height.shl(self.plan.widths().center_fraction), height)
            }
        }
    }

    /// Differences of a channel, so ordered and signed that all numerators have the sign of the result.
    fn channel_terms(&self, channel: &Channel, bits: u32, shared: &Shared<'m>) -> [Signal<'m>; 2] {
        let (major_right, flip) = (self.major_right(), shared.flip);
        let c = |place: usize| {
            let value = self.vertices.value(channel, place);
            if channel.kind.is_signed() { value.sext(bits) } else { value.zext(bits) }
        };
        let x = flip.mux(c(0), c(1)) - flip.mux(c(1), c(0));
        let (y_plus, y_minus) = (flip.mux(c(2), c(0)), flip.mux(c(0), c(2)));
        if self.plan.fill == Fill::Exact {
            return [x, y_plus - y_minus];
        }
        // DC of the left edge: the major one, or where the triangle lies left of that the part's minor one.
        let (is_nx, in_b) = (self.during(&[Op::Nx]), self.during(&[Op::ProductB, Op::LineB]));
        let to = (major_right & !in_b).mux(c(1), c(2));
        let from = (major_right & in_b).mux(c(1), c(0));
        [x, is_nx.mux(y_plus, to) - is_nx.mux(y_minus, from)]
    }
}
