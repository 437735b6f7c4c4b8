//! Simpler operators with the same value. Relations become `Eq`, `Lt` and `LtSigned`, or the `Not` of one of them; so a condition and
//! its opposite are recognised as opposites.

use edgewalk_netlist::Op;
use edgewalk_netlist::ops::mask;

use crate::graph::{Graph, ValueId};

/// What an operator on certain operands comes to, all of the same width.
pub(crate) enum Simpler {
    /// A value that is there.
    Same(ValueId),
    /// A constant.
    Constant(u128),
    /// Another operator.
    Op(Op, Vec<ValueId>),
    /// The opposite of another operator.
    NotOf(Op, Vec<ValueId>),
    /// The low bits of two values and a carry, added.
    Sum(ValueId, ValueId, ValueId),
}

/// A simpler way to say it, if there is one.
pub(crate) fn simpler(graph: &Graph, op: Op, width: u32, operands: &[ValueId]) -> Option<Simpler> {
    use Simpler::{NotOf, Op as Other, Same};
    let ones = mask(width);
    Some(match (op, operands) {
        (Op::Ne, &[a, b]) => NotOf(Op::Eq, vec![a, b]),
        (Op::Gt, &[a, b]) => Other(Op::Lt, vec![b, a]),
        (Op::Le, &[a, b]) => NotOf(Op::Lt, vec![b, a]),
        (Op::Ge, &[a, b]) => NotOf(Op::Lt, vec![a, b]),
        (Op::GtSigned, &[a, b]) => Other(Op::LtSigned, vec![b, a]),
        (Op::LeSigned, &[a, b]) => NotOf(Op::LtSigned, vec![b, a]),
        (Op::GeSigned, &[a, b]) => NotOf(Op::LtSigned, vec![a, b]),
        (Op::Eq, &[a, b]) => return equal(graph, a, b),
        (Op::Any | Op::All | Op::Parity, &[a]) if graph.width(a) == 1 => Same(a),
        (Op::And, &[a, b]) => return absorb(graph, a, b, ones, 0),
        (Op::Or, &[a, b]) => return absorb(graph, a, b, 0, ones),
        (Op::Not, &[a]) => Same(graph.as_op(a, Op::Not)?[0]),
        (Op::Mux, &[c, a, b]) => return mux(graph, c, a, b),
        (Op::Slice { hi, lo }, &[a]) => return slice(graph, hi, lo, a),
        (Op::ZeroExtend(_) | Op::SignExtend(_), &[a]) if graph.width(a) == width => Same(a),
        (Op::Concat, &[a]) => Same(a),
        (Op::Shl(0) | Op::Shr(0) | Op::Sar(0), &[a]) => Same(a),
        (Op::Add, &[a, b]) if graph.as_constant(a) == Some(0) => Same(b),
        (Op::Add | Op::Sub, &[a, b]) if graph.as_constant(b) == Some(0) => Same(a),
        (Op::Shl(n) | Op::Shr(n), &[_]) if n >= width => Simpler::Constant(0),
        _ => return None,
    })
}

/// A bit against a constant is the bit or its opposite; a word against 0 is not any of its bits.
fn equal(graph: &Graph, a: ValueId, b: ValueId) -> Option<Simpler> {
    let (a, value) = match (graph.as_constant(a), graph.as_constant(b)) {
        (Some(value), _) => (b, value),
        (_, value) => (a, value?),
    };
    match (graph.width(a), value) {
        (1, 0) => Some(Simpler::Op(Op::Not, vec![a])),
        (1, _) => Some(Simpler::Same(a)),
        (_, 0) => Some(Simpler::NotOf(Op::Any, vec![a])),
        _ => None,
    }
}

/// `And` and `Or`: a constant that changes nothing, one that decides, or twice the same.
fn absorb(graph: &Graph, a: ValueId, b: ValueId, nothing: u128, decides: u128) -> Option<Simpler> {
    for (constant, other) in [(a, b), (b, a)] {
        match graph.as_constant(constant) {
            Some(value) if value == nothing => return Some(Simpler::Same(other)),
            Some(value) if value == decides => return Some(Simpler::Constant(decides)),
            _ => {}
        }
    }
    (a == b).then_some(Simpler::Same(a))
}

fn mux(graph: &Graph, c: ValueId, a: ValueId, b: ValueId) -> Option<Simpler> {
    if a == b {
        return Some(Simpler::Same(a));
    }
    match graph.as_constant(c) {
        Some(0) => return Some(Simpler::Same(b)),
        Some(_) => return Some(Simpler::Same(a)),
        None => {}
    }
    if let Some(&[c]) = graph.as_op(c, Op::Not) {
        return Some(Simpler::Op(Op::Mux, vec![c, b, a]));
    }
    if let Some(&[inner, _, other]) = graph.as_op(b, Op::Mux)
        && inner == c
    {
        return Some(Simpler::Op(Op::Mux, vec![c, a, other]));
    }
    if graph.width(a) > 1 {
        return None;
    }
    match (graph.as_constant(a), graph.as_constant(b)) {
        (Some(1), Some(_)) => Some(Simpler::Same(c)),
        (Some(_), Some(_)) => Some(Simpler::Op(Op::Not, vec![c])),
        (Some(1), None) => Some(Simpler::Op(Op::Or, vec![c, b])),
        (None, Some(0)) => Some(Simpler::Op(Op::And, vec![c, a])),
        _ => None,
    }
}

/// Bits of an extension, of bits, or of one part of a concatenation.
fn slice(graph: &Graph, hi: u32, lo: u32, a: ValueId) -> Option<Simpler> {
    use crate::graph::Kind;
    if lo == 0 && hi + 1 == graph.width(a) {
        return Some(Simpler::Same(a));
    }
    let Kind::Op(op, operands) = graph.kind(a) else { return None };
    let of = |a: ValueId, hi, lo| Some(Simpler::Op(Op::Slice { hi, lo }, vec![a]));
    match (op, &**operands) {
        (Op::Slice { lo: below, .. }, &[a]) => of(a, hi + below, lo + below),
        (Op::ZeroExtend(_) | Op::SignExtend(_), &[a]) if hi < graph.width(a) => of(a, hi, lo),
        (Op::ZeroExtend(_), &[a]) if lo >= graph.width(a) => Some(Simpler::Constant(0)),
        (Op::Concat, parts) => {
            let mut below = 0;
            for part in parts.iter().rev() {
                let above = below + graph.width(*part);
                if lo >= below && hi < above {
                    return of(*part, hi - below, lo - below);
                }
                below = above;
            }
            None
        }
        (Op::Add, &[a, b]) if lo == 1 => carried(graph, a, b).or_else(|| carried(graph, b, a)),
        _ => None,
    }
}

/// The bits above the lowest of a sum of which the lowest is there for its carry: `{a, 1} + {b, carry}`.
fn carried(graph: &Graph, a: ValueId, b: ValueId) -> Option<Simpler> {
    let (Some(&[a, one]), Some(&[b, carry])) = (graph.as_op(a, Op::Concat), graph.as_op(b, Op::Concat))
    else {
        return None;
    };
    (graph.as_constant(one) == Some(1) && graph.width(carry) == 1).then_some(Simpler::Sum(a, b, carry))
}
