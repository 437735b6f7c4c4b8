//! The order of steps. A register is best read before it changes: else its old value must be kept for the readers.

use std::collections::HashMap;

use crate::design::Design;
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::step::Step;

/// Which registers and inputs each value depends on.
pub(crate) struct Readers<'d> {
    design: &'d Design,
    /// The number of each stored value in a [`Set`].
    numbers: HashMap<ValueId, usize>,
    cones: Vec<Set>,
}

/// A set of registers and inputs, a bit each.
type Set = Vec<u64>;

/// What a step does, with all within it.
struct Effect {
    reads: Set,
    writes: Set,
}

impl<'d> Readers<'d> {
    /// From the operands on.
    pub fn of(design: &'d Design) -> Readers<'d> {
        let graph: &Graph = &design.graph;
        let stored = graph.ids().filter(|id| *graph.kind(*id) == Kind::Stored);
        let numbers = stored.enumerate().map(|(number, id)| (id, number)).collect();
        let mut readers = Readers { design, numbers, cones: Vec::with_capacity(graph.len()) };
        for id in graph.ids() {
            let mut set = readers.none();
            readers.insert(&mut set, id);
            graph.operands(id).iter().for_each(|operand| unite(&mut set, &readers.cones[operand.index()]));
            readers.cones.push(set);
        }
        readers
    }

    /// The steps of a block, and of all blocks in it, in a good order.
    pub fn ordered(&self, steps: Vec<Step>) -> Vec<Step> {
        self.with_effect(steps).0
    }

    fn with_effect(&self, steps: Vec<Step>) -> (Vec<Step>, Effect) {
        let mut all = Effect { reads: self.none(), writes: self.none() };
        let mut open = Vec::new();
        for step in steps {
            let (step, effect) = match step {
                Step::If { bit, then } => {
                    let (then, mut effect) = self.with_effect(then);
                    unite(&mut effect.reads, &self.cones[bit.index()]);
                    (Step::If { bit, then }, effect)
                }
                Step::Change(group) => {
                    let effect = self.effect(&group);
                    (Step::Change(group), effect)
                }
            };
            unite(&mut all.reads, &effect.reads);
            unite(&mut all.writes, &effect.writes);
            open.push((step, effect));
        }
        (sorted(open), all)
    }

    fn effect(&self, group: &Group) -> Effect {
        let mut effect = Effect { reads: self.none(), writes: self.none() };
        let mut read = |value: ValueId| unite(&mut effect.reads, &self.cones[value.index()]);
        group.conditions.iter().copied().for_each(&mut read);
        for member in &group.members {
            match member {
                Member::Register { q, values } => {
                    values.iter().copied().for_each(&mut read);
                    self.insert(&mut effect.writes, *q);
                }
                Member::Read { memory, port } => {
                    let port = self.design.memories[*memory].reads[*port];
                    read(port.addr);
                    self.insert(&mut effect.writes, port.q);
                }
            }
        }
        effect
    }

    fn none(&self) -> Set {
        vec![0; self.numbers.len().div_ceil(64)]
    }

    fn insert(&self, set: &mut Set, stored: ValueId) {
        if let Some(number) = self.numbers.get(&stored) {
            set[number / 64] |= 1 << (number % 64);
        }
    }
}

/// Takes, again and again, the step that changes the fewest registers which others still have to read.
fn sorted(mut open: Vec<(Step, Effect)>) -> Vec<Step> {
    let harm_of = |writer: &Effect| open.iter().map(|(_, other)| common(&writer.writes, &other.reads)).sum();
    let mut harm: Vec<u32> = open.iter().map(|(_, effect)| harm_of(effect)).collect();
    for (harm, (_, effect)) in harm.iter_mut().zip(&open) {
        *harm -= common(&effect.writes, &effect.reads); // no harm to itself
    }
    let mut order = Vec::new();
    while let Some((next, _)) = harm.iter().enumerate().min_by_key(|(_, harm)| **harm) {
        let (step, gone) = open.remove(next);
        harm.remove(next);
        for (harm, (_, effect)) in harm.iter_mut().zip(&open) {
            *harm -= common(&effect.writes, &gone.reads);
        }
        order.push(step);
    }
    order
}

fn unite(set: &mut Set, other: &Set) {
    set.iter_mut().zip(other).for_each(|(a, b)| *a |= b);
}

/// How many are in both.
fn common(a: &Set, b: &Set) -> u32 {
    a.iter().zip(b).map(|(a, b)| (a & b).count_ones()).sum()
}
