//! The factors of the sums that the lanes form, and which of their digits a sum has come to.

use edgewalk_machine::{Fill, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use super::area::Area;
use super::control::Control;
use super::lines::Lines;
use super::sort::{Vertices, center_unit};
use super::steps::{Op, edge_of, rounds};
use super::top::top;
use super::walked::Walked;
use crate::wires::Registers;

/// Digits of both factors of a sum: of a, of b.
type Digits<'m> = [Signal<'m>; 2];

/// The digits that are named in a clock.
pub(super) struct Factors<'m> {
    /// For all lanes.
    pub digits: Digits<'m>,
    /// For a lane with the second minor edge beside lanes with the others.
    pub of_second: Digits<'m>,
    /// Signs of the factors, as digits.
    pub signs: Digits<'m>,
}

/// What the factors are made of.
pub(super) struct Sources<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub control: &'a Control<'m>,
    pub vertices: &'a Vertices<'m>,
    pub area: &'a Area<'m>,
    pub lines: &'a Lines<'m>,
    pub prim: &'a Registers<'m>,
    pub walked: &'a Walked<'m>,
}

impl<'m> Sources<'_, 'm> {
    /// The registers of the factors, and their digits.
    pub fn factors(&self) -> Factors<'m> {
        let (m, plan, control) = (self.m, self.plan, self.control);
        m.comment("Factors of the next sum, signed. Its first digit is the highest in which one of them differs from its sign.");
        let none = m.lit(self.bits(), 0);
        let product = |name: &str| {
            m.reg(name, self.bits()).doc("q of the major edge, times the factor's digits so far")
        };
        let shears = plan.fill == Fill::Exact && !plan.polygon.is_there();
        let products = shears.then(|| ["q_times_f", "q_times_g"].map(product));
        let choices = self.choices(products, none);
        let of_side = |side: usize, name: &str| {
            let reg = m.reg(name, self.bits()).doc("factor, signed");
            for (ops, values) in &choices {
                reg.when(control.way.named.one_of(ops), values[side]);
            }
            reg.q()
        };
        let [f, g] = [of_side(0, "f"), of_side(1, "g")];
        let digits = differs_from_sign(f) | differs_from_sign(g);
        let second = [self.low_column(1), self.lines.h1];
        let top_digit = self.top_digit(digits, second);
        control.feedback.top_digit.drive(top_digit.zext(self.left().width()));
        let at = |of: Signal<'m>| of.shr_by(self.left()).bit(0);
        let digits = [at(f).named("digit_f"), at(g).named("digit_g")];
        for (product, digit) in products.into_iter().flatten().zip(digits) {
            let sums = control.way.named.is(Op::SumX) | control.way.named.is_in(Op::Sum, 0);
            let doubled = control.sequence.first.mux(0, product.q().shl(1));
            let goes = sums & !control.rests;
            product.when(goes, doubled + digit.mux(self.prim["major_q"].q().sext(self.bits()), 0));
        }
        Factors { digits, of_second: second.map(at), signs: [f.msb(), g.msb()] }
    }

    /// Bits of a factor: what is sheared may be twice as long as a difference.
    fn bits(&self) -> u32 {
        self.plan.widths().difference + 1
    }

    /// Clocks of the sum that are left, which is the place of its digit.
    fn left(&self) -> Signal<'m> {
        self.control.sequence.left
    }

    /// Both factors of the sum that follows an operation; `products` are those with q, of exact fill.
    fn choices(&self, products: Option<[Reg<'m>; 2]>, none: Signal<'m>) -> Vec<(Vec<Op>, [Signal<'m>; 2])> {
        let (plan, lines) = (self.plan, self.lines);
        let natural = |value: Signal<'m>| value.zext(self.bits());
        let low = |place: usize| natural(self.low_column(place));
        let edge = |edge: usize| {
            let factors = || if edge < 2 { [low(0), natural(lines.h0)] } else { [low(1), natural(lines.h1)] };
            // Lanes side by side have the same factors for the major and the first minor edge.
            let both = || self.walked.edge(0).zip(self.walked.edge(1)).map(|(major, minor)| major | minor);
            let walked = if edge == 0 && plan.lanes > 1 { both() } else { self.walked.edge(edge) };
            match walked.map(|walked| walked.sext(self.bits())) {
                Some(used) => factors().map(|factor| factor & used),
                None => factors(),
            }
        };
        let of_edges = |side: usize| {
            let choice = |round: usize| edge_of(plan, 0, round).map_or(none, |number| edge(number)[side]);
            self.control.way.named.of_round(rounds(plan)[0], choice)
        };
        let heights = &self.vertices.heights;
        let mut choices = vec![
            (vec![Op::WaitDx], [of_edges(0), of_edges(1)]),
            (vec![Op::Take2], [natural(heights[0]), natural(heights[1])]),
        ];
        match products {
            Some(products) => choices.extend(self.sheared(products)),
            None if plan.polygon.is_there() => choices.extend(self.of_window()),
            None => {
                let of_part = |part: usize, h: Signal<'m>| [self.walked.part(part).mux(natural(h), 0), none];
                choices.push((vec![Op::DoubleA, Op::WaitA], of_part(0, lines.left_a)));
                choices.push((vec![Op::DoubleB, Op::WaitB], of_part(1, lines.left_b)));
            }
        }
        choices
    }

    /// Exact fill: the factors along the major edge, and from vertex 0 to the first pixel.
    fn sheared(&self, products: [Reg<'m>; 2]) -> [(Vec<Op>, [Signal<'m>; 2]); 2] {
        let (m, bits, across) = (self.m, self.bits(), &self.vertices.across);
        let along = [0, 1].map(|side| products[side].q() - across[side].sext(bits));
        let column = self.prim["major_c"].q();
        let px = column - self.area.negative.zext(column.width());
        let first = m.cat(&[px, m.lit(self.plan.widths().center_fraction, 0)]);
        let sheared = first.sext(bits) - self.vertices.u(0).sext(bits) - products[1].q();
        let sheared = m
            .reg("first_sheared", bits)
            .doc(&format!(
                "from vertex 0 right to the first pixel, less q px a line; {}, signed",
                center_unit(self.plan)
            ))
            .when(self.control.way.next.is_in(Op::Wait, 0), sheared);
        [(vec![Op::DoubleX], along), (vec![Op::AddX], [sheared.q(), self.lines.h0.zext(bits)])]
    }

    /// With POLY: the factors of the step down, and from vertex 0 to the pixel at which values start.
    fn of_window(&self) -> [(Vec<Op>, [Signal<'m>; 2]); 2] {
        let (m, bits, across) = (self.m, self.bits(), &self.vertices.across);
        let down = [0, 1].map(|side| -across[side].sext(bits));
        let from_top = |name: &str, place: Signal<'m>, vertex: Signal<'m>| {
            let center = m.cat(&[place, m.lit(self.plan.widths().center_fraction, 0)]).zext(bits);
            (center - vertex.sext(bits)).named_doc(name, "from vertex 0 to where the values start, signed")
        };
        let place = |name: &str| self.prim[name].q();
        let start = [
            from_top("start_across", place("start_x"), self.vertices.u(0)),
            from_top("start_down", place("start_y"), self.vertices.v(0)),
        ];
        [(vec![Op::DoubleX], down), (vec![Op::AddX], start)]
    }

    /// Place of the highest digit of a sum: `digits` are those of the factors that differ from their signs,
    /// `second` the factors of the second minor edge, which four lanes do beside the others.
    fn top_digit(&self, mut digits: Signal<'m>, second: [Signal<'m>; 2]) -> Signal<'m> {
        let bits = self.bits();
        if self.plan.lanes == 4 {
            let walked = self.walked.edge(2).unwrap_or_else(|| self.walked.part(1));
            let counts = (self.control.way.named.is(Op::WaitDx) & walked).named("second_counts");
            let both = (second[0].zext(bits) | second[1].zext(bits)).trunc(bits - 1);
            digits = digits | counts.mux(both, 0);
        }
        top(digits.named_doc("digits", "digits of the factors that differ from their signs"))
    }

    /// The part of an upper end's column below a whole one; textbook fill adds 1/2 px, the last bit there.
    fn low_column(&self, place: usize) -> Signal<'m> {
        let low = self.vertices.u(place).trunc(self.plan.widths().center_fraction);
        if self.plan.fill == Fill::Textbook { low | 1 } else { low }
    }
}

/// The digits of a signed number that differ from its sign.
fn differs_from_sign(number: Signal<'_>) -> Signal<'_> {
    let bits = number.width();
    number.trunc(bits - 1) ^ number.slice(bits - 1, 1)
}
