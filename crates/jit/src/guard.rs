//! Conditions as conjunctions: `advance & active & !full` is three literals, so that groups which share some of them can
//! share a branch.

use edgewalk_netlist::Op;

use crate::graph::{Graph, ValueId};

/// A bit that must have this value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Literal {
    pub bit: ValueId,
    pub high: bool,
}

impl Literal {
    /// The literal as a bit that must be 1.
    pub fn value(self, graph: &mut Graph) -> ValueId {
        if self.high { self.bit } else { graph.op(Op::Not, 1, &[self.bit]) }
    }
}

/// Literals that must all hold, in order, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Guard(Vec<Literal>);

impl Guard {
    /// What must hold for `condition` to be 1.
    pub fn of(graph: &Graph, condition: ValueId) -> Guard {
        let mut all = Vec::new();
        let mut open = vec![Literal { bit: condition, high: true }];
        while let Some(Literal { bit, high }) = open.pop() {
            let op = if high { Op::And } else { Op::Or };
            if let Some(&[not]) = graph.as_op(bit, Op::Not) {
                open.push(Literal { bit: not, high: !high });
            } else if let Some(operands) = graph.as_op(bit, op) {
                open.extend(operands.iter().map(|bit| Literal { bit: *bit, high }));
            } else if graph.as_constant(bit) != Some(u128::from(high)) {
                all.push(Literal { bit, high });
            }
        }
        all.sort_unstable();
        all.dedup();
        Guard(all)
    }

    /// The literals of both.
    pub fn common(&self, other: &Guard) -> Guard {
        self.filtered(|literal| other.has(literal))
    }

    /// The literals that are not among these.
    pub fn without(&self, known: &[Literal]) -> Guard {
        self.filtered(|literal| !known.contains(literal))
    }

    /// Whether this literal must hold.
    pub fn has(&self, literal: &Literal) -> bool {
        self.0.binary_search(literal).is_ok()
    }

    /// The literals in order.
    pub fn literals(&self) -> &[Literal] {
        &self.0
    }

    /// The literals as one bit.
    pub fn value(&self, graph: &mut Graph) -> ValueId {
        let mut all = graph.constant(1, 1);
        for literal in &self.0 {
            let bit = literal.value(graph);
            all = graph.op(Op::And, 1, &[all, bit]);
        }
        all
    }

    fn filtered(&self, keep: impl Fn(&Literal) -> bool) -> Guard {
        Guard(self.0.iter().copied().filter(keep).collect())
    }
}
