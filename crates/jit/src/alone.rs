//! What a value alone needs within a step: the tree above it that nothing else there reads. An arm of a choice with a large one is
//! computed only where the choice takes it. What other steps need of it too they work out for themselves.

use edgewalk_netlist::Op;

use crate::graph::{Graph, Kind, ValueId};
use crate::tables::Tables;

/// An arm of so many instructions or more gets a branch: about what a branch costs that is guessed wrong now and then.
const LEAST: u32 = 8;

/// Choices in arms of choices have branches to this depth, as lowering calls itself for each.
const DEEPEST: u32 = 64;

/// Of each value.
#[derive(Clone, Copy, Debug, Default)]
struct Tree {
    /// How often the step reads it: 0 if it has not to be worked out for it.
    readers: u32,
    /// Instructions, roughly, for it and for what it alone needs.
    cost: u32,
    /// Choices with branches, one in the other's arm, in what it alone needs.
    depth: u32,
    /// It is a choice with branches.
    branches: bool,
}

/// What each value alone needs in the step that was looked at last.
pub(crate) struct Alone {
    trees: Vec<Tree>,
    /// Those that the step needs.
    needed: Vec<ValueId>,
}

impl Alone {
    pub fn new(graph: &Graph) -> Alone {
        Alone { trees: vec![Tree::default(); graph.len()], needed: Vec::new() }
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
                let operands = tables.operands(graph, value);
                let first = |i: &usize| !operands[..*i].contains(&operands[*i]);
                open.extend((0..operands.len()).filter(first).map(|i| operands[i]));
            }
        }
        self.needed.sort_unstable(); // operands first
        for value in &self.needed {
            self.trees[value.index()] = self.tree(graph, tables, *value);
        }
    }

    /// Whether an arm of this choice is to be computed only where it is taken.
    pub fn branches(&self, choice: ValueId) -> bool {
        self.trees[choice.index()].branches
    }

    /// What has to be there before an operator: its operands; of a choice with branches the condition, and what an arm shares
    /// with others.
    pub fn before(&self, graph: &Graph, tables: &Tables, id: ValueId) -> Vec<ValueId> {
        let operands = tables.operands(graph, id);
        if !self.branches(id) {
            return operands.to_vec();
        }
        let mut before = vec![operands[0]];
        let mut open = operands[1..].to_vec();
        while let Some(value) = open.pop() {
            match self.trees[value.index()].readers {
                0 => {}
                1 => open.extend(tables.operands(graph, value)),
                _ => before.push(value),
            }
        }
        before
    }

    /// From the trees of its operands.
    fn tree(&self, graph: &Graph, tables: &Tables, id: ValueId) -> Tree {
        let Tree { readers, .. } = self.trees[id.index()];
        let operands = tables.operands(graph, id);
        let own = |operand: &ValueId| Some(self.trees[operand.index()]).filter(|tree| tree.readers == 1);
        let widest = operands.iter().chain([&id]).map(|value| graph.width(*value)).max();
        let cost = if widest > Some(64) { 3 } else { 1 };
        let cost =
            operands.iter().filter_map(own).fold(cost, |cost: u32, tree| cost.saturating_add(tree.cost));
        let depth = operands.iter().filter_map(own).map(|tree| tree.depth).max().unwrap_or(0);
        let is_dear = |arm: &ValueId| own(arm).is_some_and(|tree| tree.cost >= LEAST);
        let chooses = matches!(graph.kind(id), Kind::Op(Op::Mux, _)) && tables.get(id).is_none();
        let branches = chooses && depth < DEEPEST && operands[1..].iter().any(is_dear);
        Tree { readers, cost, depth: depth + u32::from(branches), branches }
    }
}
