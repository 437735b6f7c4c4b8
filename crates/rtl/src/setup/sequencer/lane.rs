//! A lane: rows of pairs, and the step.

use std::sync::Arc;

use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use super::code::ROW_BITS;

/// What tells lanes apart.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// Bits of A.
    pub rest: u32,
    /// Bits of W.
    pub whole: u32,
    /// Bits of a factor.
    pub factor: u32,
    /// t.
    pub center_fraction: u32,
    /// Bits of W below a whole column: F + 1 of a slope edge, else 0.
    pub below_column: u32,
    /// How far up a raised value goes: each t + r - e of the lane's channels once.
    pub raises: Vec<u32>,
    /// Rows of A and of W that are there from the start: place, number, what it is.
    pub constants_a: Vec<(usize, u128, String)>,
    pub constants_w: Vec<(usize, u128, String)>,
}

impl Shape {
    /// One module does for both lanes.
    pub fn is_like(&self, other: &Shape) -> bool {
        let rows = |shape: &Shape| -> Vec<(usize, u128)> {
            let all = shape.constants_a.iter().chain(&shape.constants_w);
            all.map(|(place, number, _)| (*place, *number)).collect()
        };
        let sizes = |shape: &Shape| (shape.rest, shape.whole, shape.below_column);
        (sizes(self), &self.raises) == (sizes(other), &other.raises) && rows(self) == rows(other)
    }
}

const DOC: &str = "A lane of a sequenced SETUP: the number W + A / M, -M <= A < M, and rows of such numbers.

  rows ─> row of A ─> + or - ─> [A]          one addition a clock for each: base + row or base - row,
  rows ─> row of W ─> + or - ─> [W]          base being 0, the same, twice the same, or A without its low bits

Timing: a row is addressed in the first clock, added in the second, and A and W can be written in the third.
Rules: a modulus is added or subtracted by the sign that A has before the step, so no choice waits for the sum.";

/// The netlist of a lane.
pub(super) fn lane(name: &str, shape: &Shape) -> Result<Arc<Netlist>, BuildErrors> {
    let module = Module::new(name, DOC);
    let m = &module;
    let Shape { rest, whole, factor, center_fraction: t, below_column, .. } = *shape;
    let read_row = m.input_doc("read_row", ROW_BITS, "row that is added in the next clock");
    let write_row = m.input_doc("write_row", ROW_BITS, "row that A, W or a word of a triangle is written to");
    let write_a = m.input_doc("write_a", 1, "A is written");
    let write_w = m.input_doc("write_w", 1, "W is written");
    let takes = m.input_doc("takes", 1, "a word of a triangle is written instead of A");
    let taken = m.input_doc("taken", rest, "the word");
    let steps = m.input_doc("steps", 1, "a step is done");
    let only_negative = m.input_doc("only_negative", 1, "unless A >= 0");
    let only_positive = m.input_doc("only_positive", 1, "unless A < 0");
    let base = m.input_doc("base", 2, "0: nothing; 1: A, W; 2: twice these; 3: A without its low t bits, W");
    let minus = m.input_doc("minus", 1, "the row is subtracted");
    let by_a = m.input_doc("by_a", 1, "the row is a modulus, subtracted if A >= 0");
    let columns = match below_column {
        0 => "the low bits of W stand for the row of A",
        _ => "the columns of W stand for the row of A",
    };
    let of_whole = m.input_doc("of_whole", 1, columns);
    let raises: Vec<_> = (shape.raises.iter())
        .map(|bits| {
            (*bits, m.input_doc(&format!("raise_{bits}"), 1, "the row of A is added to W too, so far up"))
        })
        .collect();

    m.comment("Rows.");
    let a = m.reg("a", rest).doc("A");
    let w = m.reg("w", whole).doc("W");
    let rows = 1 << ROW_BITS;
    let mut memory_a = m.memory("rows_a", ROW_BITS, rows, rest).doc("A of each row").starts(0);
    for (place, number, what) in &shape.constants_a {
        memory_a = memory_a.holds(*place, *number, what);
    }
    let mut memory_w = m.memory("rows_w", ROW_BITS, rows, whole).doc("W of each row").starts(0);
    for (place, number, what) in &shape.constants_w {
        memory_w = memory_w.holds(*place, *number, what);
    }
    memory_a.write(write_a | takes, write_row, takes.mux(taken, a.q()));
    memory_w.write(write_w & !takes, write_row, w.q());
    let always = m.lit(1, 1);
    let row_a = memory_a.read(always, read_row);
    let row_w = memory_w.read(always, read_row);

    m.comment("The step.");
    let negative = a.q().msb().named("negative");
    let low = factor.min(whole - below_column);
    let columns = w.q().slice(below_column + low - 1, below_column);
    let operand = of_whole.mux(columns.sext(rest.max(low)).trunc(rest), row_a);
    let subtracts = by_a.mux(!negative, minus).named("subtracts");
    let lowers = by_a.mux(negative, minus).named_doc("lowers", "W gets less");
    let nothing = base.eq(0).named("nothing");
    let twice = base.eq(2).named("twice");
    let masked = base.eq(3).named("masked");
    let low_bits = (a.q().trunc(t) & (!masked).sext(t)).named("low_bits");
    let same = m.cat(&[a.q().slice(rest - 1, t), low_bits]);
    let from_a = (twice.mux(a.q().shl(1), same) & (!nothing).sext(rest)).named("from_a");
    let from_w = (twice.mux(w.q().shl(1), w.q()) & (!nothing).sext(whole)).named("from_w");
    let raised = raises.iter().fold(row_w, |row, (bits, raise)| {
        let value = if whole > rest { row_a.sext(whole) } else { row_a.trunc(whole) };
        row | (value.shl(*bits) & raise.sext(whole))
    });
    let next_a = plus("next_a", from_a, operand ^ subtracts.sext(rest), subtracts);
    let next_w = plus("next_w", from_w, raised ^ lowers.sext(whole), subtracts);
    let kept = (only_negative & !negative) | (only_positive & negative);
    let done = (steps & !kept).named("done");
    a.when(done, next_a);
    w.when(done, next_w);
    let before = m.reg("was_negative", 1).doc("A was below 0 before this clock").set(negative);
    m.output_doc("is_negative", negative, "A < 0");
    m.output_doc("stays", before.q().eq(negative), "the step before left the sign of A");
    m.output_doc("rest", a.q(), "A");
    m.output_doc("whole", w.q(), "W");
    m.output_doc("factor", row_a.trunc(factor), "low bits of the row of A");
    module.finish()
}

/// a + b + carry; the sum has a lowest bit more, out of which the carry comes.
fn plus<'m>(name: &str, a: Signal<'m>, b: Signal<'m>, carry: Signal<'m>) -> Signal<'m> {
    let m = a.module();
    let sum =
        (m.cat(&[a, m.lit(1, 1)]) + m.cat(&[b, carry])).named_doc(name, "and a carry out of the lowest bit");
    sum.slice(a.width(), 1)
}
