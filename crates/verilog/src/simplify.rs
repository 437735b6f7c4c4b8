//! Operators of which nothing is left to write: a reader is spared `&& 1'b1`, lint a comparison that is always true.

use edgewalk_netlist::netlist::{Netlist, NodeId, Source};
use edgewalk_netlist::ops::{Bits, Op, mask};

/// The value of a constant.
pub(crate) fn constant(netlist: &Netlist, id: NodeId) -> Option<Bits> {
    match netlist.node(id).source {
        Source::Constant { value, .. } => Some(Bits { value, width: netlist.width(id) }),
        _ => None,
    }
}

/// The value of an operator that does not depend on any signal.
pub(crate) fn known(netlist: &Netlist, op: Op, operands: &[NodeId], width: u32) -> Option<u128> {
    let constants: Option<Vec<Bits>> = operands.iter().map(|id| constant(netlist, *id)).collect();
    if let Some(constants) = constants {
        return Some(op.value(width, &constants));
    }
    let is = |value: u128| {
        operands.iter().any(|id| constant(netlist, *id).is_some_and(|bits| bits.value == value))
    };
    match (op, operands) {
        (Op::And | Op::Mul | Op::MulSigned, _) if is(0) => Some(0),
        (Op::Or, _) if is(mask(width)) => Some(mask(width)),
        (Op::Shl(n) | Op::Shr(n), _) if n >= width => Some(0),
        (Op::Lt | Op::Le | Op::Gt | Op::Ge, &[a, b]) => {
            always(netlist, op, a, b, [0, mask(netlist.width(a))])
        }
        (Op::LtSigned | Op::LeSigned | Op::GtSigned | Op::GeSigned, &[a, b]) => {
            let half = 1u128 << (netlist.width(a) - 1);
            always(netlist, op, a, b, [half, half - 1])
        }
        _ => None,
    }
}

/// The result of a comparison with a constant, if it is the same for both ends of the other side's range.
fn always(netlist: &Netlist, op: Op, a: NodeId, b: NodeId, ends: [u128; 2]) -> Option<u128> {
    let width = netlist.width(a);
    let results = ends.map(|value| {
        let end = Bits { value, width };
        match (constant(netlist, a), constant(netlist, b)) {
            (Some(a), None) => Some(op.value(1, &[a, end])),
            (None, Some(b)) => Some(op.value(1, &[end, b])),
            _ => None,
        }
    });
    results[0].filter(|_| results[0] == results[1])
}

/// The operand that an operator passes on unchanged.
pub(crate) fn passed_on(netlist: &Netlist, op: Op, operands: &[NodeId], width: u32) -> Option<NodeId> {
    let is = |id: NodeId, value: u128| constant(netlist, id).is_some_and(|bits| bits.value == value);
    match (op, operands) {
        (Op::And, &[a, b]) if is(b, mask(width)) => Some(a),
        (Op::And, &[a, b]) if is(a, mask(width)) => Some(b),
        (Op::Or | Op::Xor | Op::Add | Op::Sub, &[a, b]) if is(b, 0) => Some(a),
        (Op::Or | Op::Xor | Op::Add, &[a, b]) if is(a, 0) => Some(b),
        (Op::ShlBy | Op::ShrBy | Op::SarBy, &[a, by]) if is(by, 0) => Some(a),
        (Op::Shl(0) | Op::Shr(0) | Op::Sar(0) | Op::Concat, &[a]) => Some(a),
        (Op::ZeroExtend(to) | Op::SignExtend(to), &[a]) if to == netlist.width(a) => Some(a),
        (Op::Any | Op::All | Op::Parity, &[a]) if netlist.width(a) == 1 => Some(a),
        (Op::Slice { lo: 0, hi }, &[a]) if hi + 1 == netlist.width(a) => Some(a),
        (Op::Mux, &[condition, then, _]) if is(condition, 1) => Some(then),
        (Op::Mux, &[condition, _, otherwise]) if is(condition, 0) => Some(otherwise),
        (Op::Mux, &[_, then, otherwise]) if then == otherwise => Some(then),
        _ => None,
    }
}

/// Whether two nodes are the same expression of the same signals; not if they are deeper than a condition should be.
pub(crate) fn is_same(netlist: &Netlist, one: NodeId, two: NodeId, depth: u32) -> bool {
    one == two
        || match (&netlist.node(one).source, &netlist.node(two).source) {
            (Source::Op(op, left), Source::Op(other, right)) if depth > 0 => {
                op == other
                    && left.len() == right.len()
                    && left.iter().zip(right).all(|(one, two)| is_same(netlist, *one, *two, depth - 1))
            }
            (Source::Constant { value, .. }, Source::Constant { value: other, .. }) => {
                value == other && netlist.width(one) == netlist.width(two)
            }
            _ => false,
        }
}
