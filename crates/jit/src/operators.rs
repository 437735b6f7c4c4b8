//! Puts operators into a graph: each is worked out, or said in a simpler way, where that is possible.

use edgewalk_netlist::Op;
use edgewalk_netlist::ops::Bits;

use crate::graph::{Graph, Kind, ValueId};
use crate::simplify::{Simpler, simpler};

impl Graph {
    /// The value of an operator whose operands fit it: the one that is there already, or a simpler one, or a
    /// new one.
    pub fn op(&mut self, op: Op, width: u32, operands: &[ValueId]) -> ValueId {
        let constants = operands
            .iter()
            .map(|id| Some(Bits { value: self.as_constant(*id)?, width: self.width(*id) }))
            .collect::<Option<Vec<Bits>>>();
        if let Some(constants) = constants {
            return self.constant(width, op.value(width, &constants));
        }
        match simpler(self, op, width, operands) {
            Some(Simpler::Same(id)) => id,
            Some(Simpler::Constant(value)) => self.constant(width, value),
            Some(Simpler::Op(op, operands)) => self.op(op, width, &operands),
            Some(Simpler::NotOf(op, operands)) => {
                let inner = self.op(op, width, &operands);
                self.op(Op::Not, width, &[inner])
            }
            Some(Simpler::Sum(a, b, carry)) => {
                let [a, b, carry] = [
                    (a, Op::Slice { hi: width - 1, lo: 0 }),
                    (b, Op::Slice { hi: width - 1, lo: 0 }),
                    (carry, Op::ZeroExtend(width)),
                ]
                .map(|(part, op)| self.op(op, width, &[part]));
                let sum = self.op(Op::Add, width, &[a, b]);
                self.op(Op::Add, width, &[sum, carry])
            }
            None => self.shared(Kind::Op(op, operands.into()), width),
        }
    }
}
