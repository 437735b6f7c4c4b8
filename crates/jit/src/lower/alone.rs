//! What a value alone needs: the tree above it that nothing else reads. An arm of a choice with a large one is computed only
//! where the choice takes it.

use edgewalk_netlist::Op;

use crate::design::Design;
use crate::graph::{Graph, Kind, ValueId};
use crate::step::Step;
use crate::tables::Tables;

/// An arm of so many instructions or more gets a branch: about what a branch costs that is guessed wrong now and then.
const LEAST: u32 = 8;

/// Choices in arms of choices have branches to this depth, as lowering calls itself for each.
const DEEPEST: u32 = 64;

/// Of each value.
#[derive(Clone, Copy, Debug, Default)]
struct Tree {
    /// Who reads it: values, registers, ports.
    readers: u32,
    /// Instructions, roughly, for it and for what it alone needs.
    cost: u32,
    /// Choices with branches, one in the other's arm, in what it alone needs.
    depth: u32,
    /// It is a choice with branches.
    branches: bool,
}

/// What each value alone needs.
pub(super) struct Alone(Vec<Tree>);

impl Alone {
    pub fn of(design: &Design, steps: &[Step], tables: &Tables) -> Alone {
        let graph = &design.graph;
        let mut alone = Alone(vec![Tree::default(); graph.len()]);
        alone.count_readers(design, steps, tables);
        for id in graph.ids() {
            let tree = alone.tree(graph, tables, id);
            alone.0[id.index()] = tree;
        }
        alone
    }

    /// Whether an arm of this choice is to be computed only where it is taken.
    pub fn branches(&self, choice: ValueId) -> bool {
        self.0[choice.index()].branches
    }

    /// What an arm shares with others, and so has to be there before the branch.
    pub fn shared(&self, graph: &Graph, tables: &Tables, arm: ValueId, shared: &mut Vec<ValueId>) {
        let mut open = vec![arm];
        while let Some(value) = open.pop() {
            if !matches!(graph.kind(value), Kind::Op(..)) {
                continue;
            }
            if self.0[value.index()].readers > 1 {
                shared.push(value);
            } else {
                open.extend(tables.operands(graph, value));
            }
        }
    }

    /// Readers of all that is ever computed in a clock.
    fn count_readers(&mut self, design: &Design, steps: &[Step], tables: &Tables) {
        let outputs = design.outputs.iter().map(|(_, value)| *value);
        let updates = design.registers.iter().flat_map(|register| &register.updates);
        let updates = updates.flat_map(|(when, value)| when.iter().copied().chain([*value]));
        let reads =
            design.memories.iter().flat_map(|memory| &memory.reads).flat_map(|read| [read.en, read.addr]);
        let writes = design.memories.iter().flat_map(|memory| &memory.writes);
        let writes = writes.flat_map(|write| [write.en, write.addr, write.data]);
        let mut open: Vec<ValueId> = outputs.chain(updates).chain(reads).chain(writes).collect();
        conditions(steps, &mut open);
        while let Some(value) = open.pop() {
            let readers = &mut self.0[value.index()].readers;
            *readers += 1;
            if *readers == 1 {
                let operands = tables.operands(&design.graph, value);
                let first = |i: &usize| !operands[..*i].contains(&operands[*i]);
                open.extend((0..operands.len()).filter(first).map(|i| operands[i]));
            }
        }
    }

    /// From the trees of its operands.
    fn tree(&self, graph: &Graph, tables: &Tables, id: ValueId) -> Tree {
        let Tree { readers, .. } = self.0[id.index()];
        let Kind::Op(op, _) = graph.kind(id) else {
            return Tree { readers, ..Tree::default() };
        };
        let operands = tables.operands(graph, id);
        let own = |operand: &ValueId| Some(self.0[operand.index()]).filter(|tree| tree.readers == 1);
        let widest = operands.iter().chain([&id]).map(|value| graph.width(*value)).max();
        let cost = if widest > Some(64) { 3 } else { 1 };
        let cost =
            operands.iter().filter_map(own).fold(cost, |cost: u32, tree| cost.saturating_add(tree.cost));
        let depth = operands.iter().filter_map(own).map(|tree| tree.depth).max().unwrap_or(0);
        let is_dear = |arm: &ValueId| own(arm).is_some_and(|tree| tree.cost >= LEAST);
        let chooses = *op == Op::Mux && tables.get(id).is_none();
        let branches = chooses && depth < DEEPEST && operands[1..].iter().any(is_dear);
        Tree { readers, cost, depth: depth + u32::from(branches), branches }
    }
}

/// All that steps ask.
fn conditions(steps: &[Step], all: &mut Vec<ValueId>) {
    for step in steps {
        all.extend(step.conditions());
        if let Step::If { then, .. } | Step::Unit { then, .. } = step {
            conditions(then, all);
        }
    }
}
