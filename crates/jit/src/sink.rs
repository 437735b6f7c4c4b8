//! Values sink into the arm of a choice that alone needs them. An arm that needs much is computed only where
//! the choice takes it. So is an operand of an `And` if the other operand is 1. A step sinks a value if
//! nothing else in that step reads it; other steps that need the value compute it for themselves.

use std::collections::BTreeMap;

use edgewalk_netlist::Op;

use crate::graph::{Graph, Kind, ValueId};
use crate::tables::Tables;

/// An arm of so many instructions or more gets a branch: about what a branch costs that is guessed wrong now
/// and then.
const LEAST: u32 = 8;

/// Like `LEAST`, for what is asked only if another bit is 1: one that is 1 half of the time is guessed wrong more
/// often.
const LEAST_ASKED: u32 = 12;

/// Choices in arms of choices have branches to this depth, as lowering calls itself for each.
const DEEPEST: u32 = 64;

/// Of each value.
#[derive(Clone, Copy, Debug, Default)]
struct Tree {
    /// How often the step reads it: 0 if it has not to be worked out for it.
    readers: u32,
    /// Choices with branches, one in the other's arm, at most, in what it needs.
    depth: u32,
    /// An arm that costs much: the value is a choice with branches, or an `And` of which this operand is
    /// asked only if the other is 1.
    dear: Option<ValueId>,
}

/// What is computed only where a bit says so.
pub(crate) struct Choice {
    pub bit: ValueId,
    /// If it is 1.
    pub one: ValueId,
    /// If it is 0; else the value is 0 then.
    pub zero: Option<ValueId>,
}

impl Choice {
    pub fn arms(&self) -> impl Iterator<Item = ValueId> + use<> {
        [self.one].into_iter().chain(self.zero)
    }
}

/// What each value alone needs in the step that was looked at last.
pub(crate) struct Sink {
    trees: Vec<Tree>,
    /// Values that the step needs.
    needed: Vec<ValueId>,
}

impl Sink {
    pub fn new(graph: &Graph) -> Sink {
        Sink { trees: vec![Tree::default(); graph.len()], needed: Vec::new() }
    }

    /// Looks at a step that asks for these values, where some values are there already.
    pub fn look(
        &mut self,
        graph: &Graph,
        tables: &Tables,
        asked: Vec<ValueId>,
        is_there: impl Fn(ValueId) -> bool,
    ) {
        for value in self.needed.drain(..) {
            self.trees[value.index()] = Tree::default();
        }
        let mut open = asked;
        while let Some(value) = open.pop() {
            if !matches!(graph.kind(value), Kind::Op(..)) || is_there(value) {
                continue;
            }
            let readers = &mut self.trees[value.index()].readers;
            *readers += 1;
            if *readers == 1 {
                self.needed.push(value);
                open.extend(once_each(tables.operands(graph, value)));
            }
        }
        self.needed.sort_unstable(); // operands first
        for value in &self.needed {
            self.trees[value.index()] = self.tree(graph, tables, *value);
        }
    }

    /// The choice that this value is, if an arm is to be computed only where it is taken.
    pub fn choice(&self, graph: &Graph, value: ValueId) -> Option<Choice> {
        let dear = self.trees[value.index()].dear?;
        match (graph.kind(value), graph.operands(value)) {
            (Kind::Op(Op::Mux, _), &[bit, one, zero]) => Some(Choice { bit, one, zero: Some(zero) }),
            (_, &[a, b]) if dear == a => Some(Choice { bit: b, one: a, zero: None }),
            (_, &[a, b]) => Some(Choice { bit: a, one: b, zero: None }),
            _ => None,
        }
    }

    /// What has to be there before an operator: its operands; of a choice with branches the condition, and
    /// what an arm shares with others.
    pub fn before(&self, graph: &Graph, tables: &Tables, id: ValueId) -> Vec<ValueId> {
        let Some(choice) = self.choice(graph, id) else { return tables.operands(graph, id).to_vec() };
        let mut before = vec![choice.bit];
        for arm in choice.arms() {
            self.walk(graph, tables, arm, |value, is_own| {
                if !is_own {
                    before.push(value);
                }
                true
            });
        }
        before
    }

    /// From an arm down, readers first: each value that has to be worked out, and whether only the arm needs
    /// it, as far as all that read it are such. Until `next` says no.
    fn walk(
        &self,
        graph: &Graph,
        tables: &Tables,
        arm: ValueId,
        mut next: impl FnMut(ValueId, bool) -> bool,
    ) {
        let mut open = BTreeMap::from([(arm, 1)]);
        while let Some((value, readers)) = open.pop_last() {
            let all = self.trees[value.index()].readers;
            if all == 0 {
                continue;
            }
            if !next(value, readers == all) {
                return;
            }
            if readers == all {
                once_each(tables.operands(graph, value))
                    .for_each(|operand| *open.entry(operand).or_insert(0) += 1);
            }
        }
    }

    /// Whether what only this arm needs costs so much, in instructions, roughly.
    fn is_dear(&self, graph: &Graph, tables: &Tables, arm: ValueId, least: u32) -> bool {
        let mut cost = 0;
        self.walk(graph, tables, arm, |value, is_own| {
            let widest = graph.operands(value).iter().chain([&value]).map(|value| graph.width(*value)).max();
            cost += if !is_own {
                0
            } else if widest > Some(64) {
                3
            } else {
                1
            };
            cost < least
        });
        cost >= least
    }

    /// From the trees of its operands.
    fn tree(&self, graph: &Graph, tables: &Tables, id: ValueId) -> Tree {
        let operands = tables.operands(graph, id);
        let depth = operands.iter().map(|operand| self.trees[operand.index()].depth).max().unwrap_or(0);
        let (arms, least) = match graph.kind(id) {
            _ if depth >= DEEPEST || tables.get(id).is_some() => (&[][..], 0),
            Kind::Op(Op::Mux, _) => (&operands[1..], LEAST),
            Kind::Op(Op::And, _) if graph.width(id) == 1 => (operands, LEAST_ASKED),
            _ => (&[][..], 0),
        };
        let dear = arms.iter().copied().find(|arm| self.is_dear(graph, tables, *arm, least));
        Tree { dear, depth: depth + u32::from(dear.is_some()), ..self.trees[id.index()] }
    }
}

/// The operands, none of them twice.
fn once_each(operands: &[ValueId]) -> impl Iterator<Item = ValueId> {
    let first = |at: &usize| !operands[..*at].contains(&operands[*at]);
    (0..operands.len()).filter(first).map(|at| operands[at])
}
