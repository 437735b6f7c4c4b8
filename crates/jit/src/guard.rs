//! What a condition needs: `advance & active & !full` is 1 only if three other bits have certain values. Steps that need the
//! same bit can share a branch.

use std::collections::{BTreeSet, HashMap};

use edgewalk_netlist::Op;

use crate::graph::{Graph, ValueId};

/// How far into `And` and `Or` a need is followed.
const DEPTH: u32 = 12;

/// A bit that must have this value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Literal {
    pub bit: ValueId,
    pub high: bool,
}

impl Literal {
    /// A bit that must be 1; for one that is computed as the opposite of another, that other one must be 0.
    pub fn of(graph: &Graph, bit: ValueId) -> Literal {
        match graph.as_op(bit, Op::Not) {
            Some(&[not]) => Literal { bit: not, high: false },
            _ => Literal { bit, high: true },
        }
    }

    /// The literal as a bit that must be 1.
    pub fn value(self, graph: &mut Graph) -> ValueId {
        if self.high { self.bit } else { graph.op(Op::Not, 1, &[self.bit]) }
    }

    /// The two literals that must both hold, or one of which must hold, for this one to hold.
    fn parts(self, graph: &Graph) -> Option<(Op, [Literal; 2])> {
        let both = if self.high { Op::And } else { Op::Or };
        let part = |bit: ValueId| {
            let literal = Literal::of(graph, bit);
            Literal { high: literal.high == self.high, ..literal }
        };
        [Op::And, Op::Or].into_iter().find_map(|op| match graph.as_op(self.bit, op) {
            Some(&[a, b]) => Some((if op == both { Op::And } else { Op::Or }, [part(a), part(b)])),
            _ => None,
        })
    }
}

/// What conditions need, as far as it has been asked.
#[derive(Debug, Default)]
pub(crate) struct Needs(HashMap<Literal, BTreeSet<Literal>>);

impl Needs {
    /// All literals that hold whenever this one does, itself too.
    pub fn of(&mut self, graph: &Graph, literal: Literal) -> BTreeSet<Literal> {
        self.followed(graph, literal, DEPTH)
    }

    fn followed(&mut self, graph: &Graph, literal: Literal, depth: u32) -> BTreeSet<Literal> {
        if let Some(known) = self.0.get(&literal) {
            return known.clone();
        }
        let mut needs = BTreeSet::from([literal]);
        if depth > 0
            && let Some((op, parts)) = literal.parts(graph)
        {
            let [a, b] = parts.map(|part| self.followed(graph, part, depth - 1));
            match op {
                Op::And => needs.extend(a.union(&b)),
                _ => needs.extend(a.intersection(&b)),
            }
        }
        self.0.insert(literal, needs.clone());
        needs
    }
}
