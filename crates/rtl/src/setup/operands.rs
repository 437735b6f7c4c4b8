//! What the lanes multiply and divide in each operation.

use edgewalk_netlist::{Instance, Module, Signal};
use edgewalk_numerics::{EdgeKind, Fill, Machine};

use super::control::Control;
use super::lane::Shape;
use super::lines::Lines;
use super::schedule::{Kind, Op, late};
use super::sort::{ENDS, Vertices};
use crate::token::Registers;

/// What operands are made of.
pub(super) struct Sources<'a, 'm> {
    pub m: &'m Module,
    pub machine: &'a Machine,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub lines: &'a Lines<'m>,
    pub prim: &'a Registers<'m>,
    /// |area|, unsigned.
    pub area: Signal<'m>,
}

/// The operands that all lanes share in the operations on channels.
pub(super) struct Shared<'m> {
    a: Signal<'m>,
    b: Signal<'m>,
    divisor: Signal<'m>,
}

impl<'m> Sources<'_, 'm> {
    fn left(&self) -> Signal<'m> {
        self.prim["left"].q()
    }

    fn during(&self, ops: &[Op]) -> Signal<'m> {
        self.control.during(ops)
    }

    /// How far the centres of a line lie below a vertex: line·P − v, signed, DW bits.
    fn below(&self, line: Signal<'m>, v: Signal<'m>) -> Signal<'m> {
        let w = self.machine.widths();
        self.m.cat(&[line, self.m.lit(w.center_fraction, 0)]) - v.sext(w.difference)
    }

    /// In exact fill C is a ceiling: setup divides −N.
    fn negates(&self) -> bool {
        self.machine.fill == Fill::Exact && self.machine.edge_kind == EdgeKind::Exact
    }

    /// The factors and the divisor of the operations on channels.
    pub fn shared(&self) -> Shared<'m> {
        self.m.comment("Factors and divisor of the operations on channels, the same for all lanes.");
        let (a, b, divisor) = match self.machine.fill {
            Fill::Exact => self.shared_exact(),
            Fill::Textbook => self.shared_textbook(),
        };
        Shared {
            a: a.named_doc("channel_a", "signed"),
            b: b.named_doc("channel_b", "signed"),
            divisor: divisor.named_doc("channel_divisor", "unsigned"),
        }
    }

    fn shared_exact(&self) -> (Signal<'m>, Signal<'m>, Signal<'m>) {
        let (m, v, dw) = (self.m, self.vertices, self.machine.widths().difference);
        let (t, left) = (self.machine.widths().center_fraction, self.left());
        let column = self.prim["major_c"].q() - left.zext(self.machine.widths().column);
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
        let (v, dw, left) = (self.vertices, self.machine.widths().difference, self.left());
        let in_b = self.during(&[Op::ProductB, Op::StartB, Op::LineB]).named_doc("in_b", "part 2");
        let line = in_b.mux(self.lines.j1, self.lines.j0);
        let top = (in_b & left).mux(v.v(1), v.v(0));
        let is_nx = self.during(&[Op::Nx]);
        let a = is_nx.mux(v.heights[0].zext(dw), 0);
        let b = is_nx.mux(v.heights[1].zext(dw), self.below(line, top));
        let minor = in_b.mux(v.heights[2], v.heights[1]);
        let height = left.mux(minor, v.heights[0]).zext(self.area.width());
        (a, b, self.during(&[Op::Gx]).mux(self.area, height).trunc(2 * dw - 1))
    }

    /// Connects the operands of a lane.
    pub fn connect(&self, lane: usize, shape: &Shape, shared: &Shared<'m>, instance: Instance<'m>) {
        self.m.comment(&format!("Lane {lane}."));
        let job = |round: usize| round * self.machine.dividers as usize + lane;
        let by_round = |of: &dyn Fn(usize) -> Signal<'m>| self.control.of_round(|round| of(job(round)));
        let edges = self.control.in_edges;
        let [x_channel, y_channel] =
            [0, 1].map(|term| by_round(&|job| self.channel_terms(job, shape.terms)[term]));
        let [x_edge, y_edge] = [0, 1].map(|term| by_round(&|job| self.edge_terms(job, shape.terms)[term]));
        let [a_edge, b_edge] = [0, 1].map(|factor| by_round(&|job| self.edge_factors(job)[factor]));
        let divisor = by_round(&|job| self.edge_divisor(job, shape.divisor));
        instance
            .connect("x_in", edges.mux(x_edge, x_channel))
            .connect("y_in", edges.mux(y_edge, y_channel))
            .connect("a_in", edges.mux(a_edge, shared.a))
            .connect("b_in", edges.mux(b_edge, shared.b))
            .connect("divisor_in", edges.mux(divisor, shared.divisor));
        self.connect_control(lane, shape, instance);
    }

    /// Factors of the area (job 0), or of N of an edge.
    fn edge_factors(&self, job: usize) -> [Signal<'m>; 2] {
        let (v, dw) = (self.vertices, self.machine.widths().difference);
        let Some(edge) = job.checked_sub(1) else {
            return [v.heights[0].zext(dw), v.heights[1].zext(dw)];
        };
        let (from, line) = (ENDS[edge].0, [self.lines.jm, self.lines.j0, self.lines.j1][edge]);
        let u = v.u(from);
        let a = match self.machine.fill {
            Fill::Exact => u,
            // u + o: u = 2x is even.
            Fill::Textbook => self.m.cat(&[u.slice(u.width() - 1, 1), self.m.lit(1, 1)]),
        };
        [a.sext(dw), self.below(line, v.v(from))]
    }

    /// Terms of the area: du1, −du2; of N: DY, DX, or of −N their negatives.
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
        match self.machine.edge_kind {
            EdgeKind::Exact => height,
            EdgeKind::Slope => {
                self.during(&[Op::EdgeStart]).mux(height.shl(self.machine.widths().center_fraction), height)
            }
        }
    }

    /// Differences of a channel, so ordered and signed that all numerators have the sign of the result.
    fn channel_terms(&self, channel: usize, bits: u32) -> [Signal<'m>; 2] {
        let (left, during) = (self.left(), |ops: &[Op]| self.during(ops));
        let c = |place: usize| self.vertices.value(channel, place).zext(bits);
        // Nx = σ(dc1·dv2 − dc2·dv1); Ny = σ(dc2·du1 − dc1·du2), its terms in the same places.
        let flip = match self.machine.fill {
            Fill::Exact => left ^ during(&[Op::Ny]),
            Fill::Textbook => left,
        };
        let x = flip.mux(c(0), c(1)) - flip.mux(c(1), c(0));
        let y_plus = flip.mux(c(2), c(0));
        let y_minus = flip.mux(c(0), c(2));
        if self.machine.fill == Fill::Exact {
            return [x, y_plus - y_minus];
        }
        // DC of the left edge: the major one, or where the triangle lies left of that the part's minor one.
        let (is_nx, in_b) = (during(&[Op::Nx]), during(&[Op::ProductB, Op::LineB]));
        let to = (left & !in_b).mux(c(1), c(2));
        let from = (left & in_b).mux(c(1), c(0));
        [x, is_nx.mux(y_plus, to) - is_nx.mux(y_minus, from)]
    }

    /// What the lane does in this clock.
    fn connect_control(&self, lane: usize, shape: &Shape, instance: Instance<'m>) {
        let (m, control, machine) = (self.m, self.control, self.machine);
        let of_kind = |kind: Kind| {
            let ops: Vec<Op> = control.ops().filter(|op| op.kind() == kind).collect();
            control.during(&ops)
        };
        let (product, quotient, of_y) =
            (of_kind(Kind::Product), of_kind(Kind::Quotient), of_kind(Kind::QuotientOfY));
        let product_step = control.stepping & product;
        let terms = [Op::EdgeProduct, Op::Nx, Op::Ny, Op::ProductA, Op::ProductB];
        instance
            .connect("load_terms", control.load & control.during(&terms))
            .connect("load_factors", control.load & product)
            .connect("load_divisor", control.load & quotient)
            .connect("from_y", control.load & of_y)
            .connect("step_product", product_step)
            .connect("first_step", control.step.eq(1))
            .connect("step_quotient", control.stepping & (quotient | of_y) & self.started(lane))
            .connect("digit_at", self.digit_at(lane, shape).unwrap_or(m.lit(1, 0)));
        if machine.fill == Fill::Exact {
            instance
                .connect("keep_nx", control.after(Op::Nx))
                .connect("load_gradients", control.load & control.during(&[Op::LineProduct]))
                .connect("keep_gx", control.after(Op::Gx))
                .connect("add_line", control.after(Op::Line));
        }
    }

    fn channel_of(&self, lane: usize, round: usize) -> edgewalk_numerics::Channel {
        self.machine.channels()[round * self.machine.dividers as usize + lane]
    }

    /// A channel with a shorter word than another has fewer digits and begins later.
    fn started(&self, lane: usize) -> Signal<'m> {
        let started = self.control.of_round(|round| {
            let late = late(self.machine, self.channel_of(lane, round));
            if late == 0 { self.m.lit(1, 1) } else { self.control.step.gt(late as i32) }
        });
        self.control.in_edges | started
    }

    /// Where the operation's digits are, as a place in the shape's list.
    fn digit_at(&self, lane: usize, shape: &Shape) -> Option<Signal<'m>> {
        let place = |op: Op, round: usize| {
            let bit = op.first_digit(self.machine, self.channel_of(lane, round));
            let place = shape.first_digits.iter().position(|digit| *digit == bit).unwrap_or(0);
            self.m.lit(shape.digit_select(), place as u128)
        };
        let ops = self.control.ops().filter(|op| op.kind() != Kind::Product);
        let choices = ops.map(|op| (self.during(&[op]), self.control.of_round(|round| place(op, round))));
        choices
            .reduce(|(_, chosen), (during, other)| (during, during.mux(other, chosen)))
            .map(|(_, chosen)| chosen)
    }
}
