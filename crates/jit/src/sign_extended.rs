//! Registers that are kept sign-extended, with copies of their sign above their bits instead of zeros: those
//! that are read more often so. A sum of such registers has its sign where it belongs, and needs no mask to
//! be stored.

use edgewalk_netlist::Op;

use crate::design::Design;
use crate::graph::{Graph, Kind, ValueId};

/// Which registers these are.
pub(crate) struct Signs(Vec<bool>);

impl Signs {
    pub fn of(design: &Design) -> Signs {
        let graph = &design.graph;
        let mut wanted = vec![0i32; graph.len()];
        // Readers first: a choice wants of its arms what is wanted of it.
        for id in graph.ids().rev() {
            let Kind::Op(op, operands) = graph.kind(id) else { continue };
            for (place, operand) in operands.iter().enumerate() {
                wanted[operand.index()] += match op {
                    Op::Mux => wanted[id.index()].signum(),
                    _ => wish(graph, *op, place, id, *operand),
                };
            }
        }
        let mut signs = Signs(vec![false; graph.len()]);
        for register in &design.registers {
            // A bit is 0 or 1, and in a whole word there is nothing above.
            let has_room = (2..64).contains(&graph.width(register.q));
            signs.0[register.q.index()] = has_room && wanted[register.q.index()] > 0;
        }
        signs
    }

    /// Whether this is one of them.
    pub fn has(&self, register: ValueId) -> bool {
        self.0[register.index()]
    }
}

/// 1 if the operator reads the operand at this place with copies of its sign, -1 if with zeros, 0 if it does
/// not matter.
fn wish(graph: &Graph, op: Op, place: usize, id: ValueId, operand: ValueId) -> i32 {
    match op {
        Op::SignExtend(_) | Op::Sar(_) | Op::LtSigned | Op::MulSigned => 1,
        Op::SarBy if place == 0 => 1,
        Op::Slice { hi, lo } if hi == lo && hi + 1 == graph.width(operand) => 1,
        Op::Slice { hi, .. } if hi + 1 == graph.width(operand) => -1,
        Op::Concat if place == 0 || graph.width(id) == graph.width(operand) => 0,
        Op::Add | Op::Sub | Op::Neg | Op::And | Op::Or | Op::Xor | Op::Not => 0,
        Op::Shl(_) | Op::ShlBy | Op::Slice { .. } if place == 0 => 0,
        _ => -1,
    }
}
