//! One lane: holds a pair and moves it a step a clock.

mod inputs;
mod step;
mod whole;

use std::sync::Arc;

use edgewalk_machine::{Channel, EdgeKind, Plan};
use edgewalk_netlist::{BuildErrors, Module, Netlist, Signal};

use super::area::area_bits;
use super::steps::{StepCodes, longest_value};
use inputs::Inputs;
use step::{Modulus, Rest};

/// Word lengths of a lane, bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// What it takes in, signed.
    pub number: u32,
    /// The whole part, modular.
    pub whole: u32,
    /// The modulus, negated. It is longer than what is taken in; the remainder part has no sign.
    pub modulus: u32,
}

impl Shape {
    /// Of a lane for these channels, and for edges.
    pub fn new(plan: &Plan, channels: &[Channel]) -> Shape {
        let w = plan.widths();
        let of_edge = match plan.edge_kind {
            EdgeKind::Exact => w.column,
            EdgeKind::Slope => w.column + plan.edge_fraction,
        };
        let values = channels.iter().map(|c| c.vertex_bits() + 1).max().unwrap_or(1);
        let words = channels.iter().map(|c| c.word() + w.center_fraction).max().unwrap_or(1);
        Shape { number: w.difference.max(values), whole: of_edge.max(words), modulus: modulus_bits(plan) }
    }
}

/// Bits of the modulus, negated: P·DY, the area, or up to four times the longest difference of values.
pub(super) fn modulus_bits(plan: &Plan) -> u32 {
    area_bits(plan).max(longest_value(plan) + 4)
}

const DOC: &str = "A lane of setup holds a pair: the number whole + rest / M, with 0 <= rest < M.

  slots ─> a ─> [n0 n1 n2 = a, a - M, a - 2M] ─┐
                                 x = rest * 1 2 4 ─> + ─> the last sum not below 0 ─> [rest]
                                                          how often M was taken off ─> [whole], a clock later

Timing: a step takes three clocks. Its addend is read, then n0 n1 n2 are formed, then it is done.
Rules: in a doubling step n0 n1 n2 are -M, -2M and -3M, so that up to 3 M can be taken off. To a number below 0 that is taken in
M is added, and -1 is its whole part. So it is with a pair that is subtracted: M - a is added, and the complement of its whole part.";

/// The netlist of a lane.
pub(super) fn lane(name: &str, shape: Shape) -> Result<Arc<Netlist>, BuildErrors> {
    let m = Module::new(name, DOC);
    let inputs = Inputs::new(&m, shape);
    let codes = StepCodes::new(&m);
    let modulus = Modulus::new(&m, &inputs);
    let rest = Rest::new(&m, &inputs);
    let addends = step::addends(&m, &inputs, &codes, &modulus, rest.stored);
    let step = step::step(&m, &inputs, &codes, &addends, &rest);
    let whole = whole::whole(&m, &inputs, &codes, &step);
    whole::give(&m, &inputs, &modulus, rest.now, whole);
    m.finish()
}

/// What is read is not written in this clock. No pair that is needed ever is: said, it spares what would keep
/// the old word.
fn apart<'m>(write: Signal<'m>, write_at: Signal<'m>, read_at: Signal<'m>) -> Signal<'m> {
    !(write & write_at.eq(read_at))
}

/// Whether it was so a clock before.
fn flag<'m>(m: &'m Module, name: &str, is: Signal<'m>) -> Signal<'m> {
    m.reg(name, 1).set(is).q()
}

/// A bit as often as a word is long.
fn repeat(bit: Signal<'_>, bits: u32) -> Signal<'_> {
    bit.sext(bits)
}
