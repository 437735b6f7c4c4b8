//! One lane: a serial multiplier and a serial divider that share an accumulator.

use std::sync::Arc;

use edgewalk_machine::{EdgeKind, Fill, Plan, Precision};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Reg, Signal};

use super::schedule::{Kind, Op, channel_jobs, edge_jobs};

/// What a lane must be able to hold, in bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// Inputs x_in and y_in, signed: differences of coordinates or of a channel.
    pub terms: u32,
    /// Registers x and y, signed: as the inputs, or Nx and Ny.
    pub wide_terms: u32,
    /// Accumulator, signed.
    pub acc: u32,
    /// Quotient, modular.
    pub quotient: u32,
    /// Divisor and remainder, unsigned.
    pub divisor: u32,
    /// Bits of the accumulator that are the first digit of an operation's numerator.
    pub first_digits: Vec<u32>,
}

impl Shape {
    /// Of lane number `lane`.
    pub fn new(plan: &Plan, lane: usize) -> Shape {
        let w = plan.widths();
        let channels = channel_jobs(plan, lane);
        let has_edge = edge_jobs(plan, lane).iter().any(|job| *job > 0);
        let most = |bits: fn(Precision) -> u32| channels.iter().map(|c| bits(c.precision)).max().unwrap_or(1);
        let (values, word) = (most(Precision::vertex_bits), most(Precision::word));
        let terms = w.difference.max(values + 1);
        let (wide_terms, product) = match plan.fill {
            Fill::Exact => (w.difference + values + 1, 2 * w.difference + values + 1),
            Fill::Textbook => (terms, (w.difference + values + 1).max(2 * w.difference)),
        };
        let edge_quotient = match plan.edge_kind {
            EdgeKind::Exact => w.column,
            EdgeKind::Slope => w.column + plan.edge_fraction,
        };
        let edges = Op::of_edges().iter().filter(|_| has_edge);
        let ops = edges.chain(Op::of_channels(plan)).filter(|op| op.kind() != Kind::Product);
        let mut first_digits: Vec<u32> =
            ops.flat_map(|op| channels.iter().map(|c| op.first_digit(plan, *c))).collect();
        first_digits.sort_unstable();
        first_digits.dedup();
        let highest = first_digits.last().map_or(0, |digit| digit + 1);
        Shape {
            terms,
            wide_terms,
            acc: product.max(highest),
            quotient: word.max(edge_quotient),
            divisor: 2 * w.difference - 1,
            first_digits,
        }
    }

    /// Bits of `digit_at`, the place in `first_digits`.
    pub fn digit_select(&self) -> u32 {
        (self.first_digits.len() as u32).next_power_of_two().ilog2().max(1)
    }
}

const DOC: &str = "A lane of setup multiplies and divides serially, k bits a clock.

  a b ─> digits ─> [acc := 2^k acc + a_i x + b_i y] ─ digits of |acc| ─> [rem := 2 rem + digit, less divisor if it fits]
  x y ────────────────┘                                                     └─ 1 if it fit ─> [quot]

Timing: a clock to load, then k bits a clock, the most significant first; results stand from the next clock on.
Rules: products are signed; in the first step the sign bits of a and b subtract. Quotients are rounded down
(quotient, remainder) or to nearest, halves up (rounded). Of a quotient the low bits are kept: the rest falls out.";

/// The netlist of a lane of this shape.
pub(super) fn lane(plan: &Plan, name: &str, shape: &Shape) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new(name, DOC);
    let begins = Begins {
        of_acc: m.input_doc("load_divisor", 1, "a division of acc begins"),
        of_y: m.input_doc("from_y", 1, "a division of y_in begins"),
        y: m.input_doc("y_in", shape.terms, "signed"),
        step: m.input("step_quotient", 1),
    };
    let product = Product::new(&m, plan, shape, &begins);
    let quotient = Quotient::new(&m, plan, shape, &begins, product.acc);
    m.output_doc("product", product.acc, "signed");
    m.output_doc("quotient", quotient.floor, "rounded down, modular");
    m.output_doc("remainder", quotient.remainder, "0 to divisor - 1");
    m.output_doc("rounded", quotient.rounded, "rounded to nearest, halves up, modular");
    if plan.fill == Fill::Exact {
        gradients(&m, shape, &product, &quotient);
    }
    m.finish()
}

/// How a division begins and goes on.
struct Begins<'m> {
    of_acc: Signal<'m>,
    of_y: Signal<'m>,
    y: Signal<'m>,
    step: Signal<'m>,
}

/// The multiplier.
struct Product<'m> {
    x: Reg<'m>,
    y: Reg<'m>,
    acc: Signal<'m>,
}

impl<'m> Product<'m> {
    fn new(m: &'m Module, plan: &Plan, shape: &Shape, begins: &Begins<'m>) -> Product<'m> {
        let (k, dw) = (plan.bits_per_clock(), plan.widths().difference);
        let a_in = m.input_doc("a_in", dw, "factor of x, signed");
        let b_in = m.input_doc("b_in", dw, "factor of y, signed");
        let x_in = m.input_doc("x_in", shape.terms, "signed");
        let load_terms = m.input_doc("load_terms", 1, "x := x_in, y := y_in");
        let load_factors = m.input_doc("load_factors", 1, "a := a_in, b := b_in, acc := 0");
        let step = m.input("step_product", 1);
        let first_step = m.input_doc("first_step", 1, "of a product");

        m.comment("Terms and factors of a product.");
        let x = m.reg("x", shape.wide_terms).doc("term, signed");
        let y = m.reg("y", shape.wide_terms).doc("term, signed");
        x.when(load_terms, x_in.sext(shape.wide_terms));
        y.when(load_terms, begins.y.sext(shape.wide_terms));
        let bits = dw.next_multiple_of(k);
        let factor = |name: &str, input: Signal<'m>| {
            let factor = m.reg(name, bits).doc("factor, its next bits at the top");
            factor.when(step, factor.q().shl(k)).when(load_factors, input.sext(bits)).q()
        };
        let (a, b) = (factor("a", a_in), factor("b", b_in));

        m.comment("A step. The sign bits subtract; then acc is 0, and its doubled lowest bit is free for -t = ~t + 1.");
        let acc = m.reg("acc", shape.acc).doc("product, or what is left of a numerator; signed");
        let mut sum = acc.q();
        for i in 0..k {
            let part = |factor: Signal<'m>, term: Reg<'m>| {
                factor.bit(bits - 1 - i).mux(term.q().sext(shape.wide_terms + 1), 0)
            };
            let parts = (part(a, x) + part(b, y)).sext(shape.acc);
            let (parts, lowest) =
                if i == 0 { (first_step.mux(!parts, parts), first_step) } else { (parts, m.lit(1, 0)) };
            sum = (m.cat(&[sum.trunc(shape.acc - 1), lowest]) + parts).named(&format!("sum{i}"));
        }
        acc.when(begins.step, acc.q().shl(k))
            .when(step, sum)
            .when(load_factors, 0)
            .when(begins.of_y, begins.y.sext(shape.acc));
        Product { x, y, acc: acc.q() }
    }
}

/// The divider.
struct Quotient<'m> {
    divisor: Signal<'m>,
    floor: Signal<'m>,
    remainder: Signal<'m>,
    rounded: Signal<'m>,
}

impl<'m> Quotient<'m> {
    fn new(m: &'m Module, plan: &Plan, shape: &Shape, begins: &Begins<'m>, acc: Signal<'m>) -> Quotient<'m> {
        let k = plan.bits_per_clock();
        let divisor_in = m.input_doc("divisor_in", shape.divisor, "unsigned");
        let digit_at = m.input_doc("digit_at", shape.digit_select(), "which bits of acc are the next digits");

        m.comment(
            "The numerator: acc without its sign, k digits a clock from where this operation has them.",
        );
        let negative = m.reg("negative", 1).doc("the numerator is below 0");
        negative.when(begins.of_acc, acc.msb()).when(begins.of_y, begins.y.msb());
        let digits_from = |bit: u32| acc.slice(bit, bit + 1 - k);
        let places = shape.first_digits.iter().enumerate();
        let digits = places.map(|(i, bit)| (digit_at.eq(i as i32), digits_from(*bit)));
        let digits = digits.reduce(|(_, chosen), (here, other)| (here, here.mux(other, chosen)));
        let digits = digits.map_or(acc.trunc(k), |(_, digits)| digits).named("digits");

        m.comment("A step: the divisor is taken away wherever it fits.");
        let begin = (begins.of_acc | begins.of_y).named("begin_division");
        let divisor = m.reg("divisor", shape.divisor).doc("unsigned").when(begin, divisor_in).q();
        let wide_divisor = divisor.zext(shape.divisor + 1);
        let rem = m.reg("rem", shape.divisor).doc("remainder so far");
        let quot = m.reg("quot", shape.quotient).doc("quotient so far, modular");
        let (mut rest, mut bits) = (rem.q(), quot.q());
        for i in 0..k {
            let digit = digits.bit(k - 1 - i) ^ negative;
            let shifted = m.cat(&[rest, digit]);
            let less = (shifted - wide_divisor).named(&format!("less{i}"));
            let fits = (!less.msb()).named(&format!("fits{i}"));
            rest = fits.mux(less, shifted).trunc(shape.divisor).named(&format!("rest{i}"));
            bits = m.cat(&[bits.trunc(shape.quotient - 1), fits]);
        }
        rem.when(begins.step, rest).when(begin, 0);
        quot.when(begins.step, bits);

        m.comment("Below 0: floor(N/D) = ~floor(~N/D), and the remainder is D - 1 - r.");
        let floor = negative.q().mux(!quot.q(), quot).named_doc("floor", "modular");
        let remainder = negative.q().mux(divisor + !rem.q(), rem).named("floor_remainder");
        // Up if 2r >= D for N >= 0, if 2(D - 1 - r) >= D, that is 2r + 1 < D, for N < 0.
        let below_half = m.cat(&[rem.q(), negative.q()]).lt(wide_divisor);
        let up = below_half.eq(negative).named_doc("up", "the next higher is nearest");
        Quotient { divisor, floor, remainder, rounded: floor + up.zext(shape.quotient) }
    }
}

/// Nx and Ny as terms, and d1 from the quotients of gx and d0.
fn gradients<'m>(m: &'m Module, shape: &Shape, product: &Product<'m>, quotient: &Quotient<'m>) {
    m.comment("Nx waits here while Ny is formed; then both are terms.");
    let keep_nx = m.input_doc("keep_nx", 1, "nx := acc");
    let load_gradients = m.input_doc("load_gradients", 1, "x := nx, y := acc");
    let found = product.acc.trunc(shape.wide_terms);
    let nx = m.reg("nx", shape.wide_terms).doc("Nx, signed").when(keep_nx, found);
    product.x.when(load_gradients, nx);
    product.y.when(load_gradients, found);

    m.comment(
        "d1 = RN of the sum of the numerators of d0 and gx: from the sums of their quotients and remainders.",
    );
    let keep_gx = m.input_doc("keep_gx", 1, "the quotient is that of gx");
    let add_line = m.input_doc("add_line", 1, "the quotient is that of d0");
    let both = m.reg("both", shape.quotient).doc("sum of the quotients, modular");
    both.when(add_line, both.q() + quotient.floor).when(keep_gx, quotient.floor);
    let bits = shape.divisor + 1;
    let remainder = quotient.remainder.zext(bits);
    let rest = m.reg("rest", bits).doc("sum of the remainders, below 2 divisors");
    rest.when(add_line, rest.q() + remainder).when(keep_gx, remainder);
    let twice = m.cat(&[rest.q(), m.lit(1, 0)]);
    let once = quotient.divisor.zext(bits + 1);
    let reaches = |times: Signal<'m>, name: &str| twice.ge(times).named(name).zext(shape.quotient);
    let d1 = both.q() + reaches(once, "half") + reaches(once + once.shl(1), "three_halves");
    m.output_doc("d1", d1, "modular");
}
