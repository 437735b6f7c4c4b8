//! The order of steps. A register is best read before it changes: else its old value must be kept for the readers.

use std::collections::HashMap;

use crate::design::Design;
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::step::Step;

/// Registers of a step that change in every clock; more at once would not find room in the processor.
const MOST_JOINED: usize = 16;

/// Which registers and inputs each value depends on.
pub(crate) struct Readers<'d> {
    design: &'d Design,
    /// The number of each stored value in a [`Set`].
    numbers: HashMap<ValueId, usize>,
    cones: Vec<Set>,
}

/// A set of registers and inputs, a bit each.
pub(crate) type Set = Vec<u64>;

/// What a step does, with all within it.
struct Effect {
    reads: Set,
    writes: Set,
    /// Memories of which it reads words, a bit each.
    looks: Set,
    /// The memory of which it writes words.
    fills: Option<usize>,
}

impl Effect {
    fn unite(&mut self, other: &Effect) {
        unite(&mut self.reads, &other.reads);
        unite(&mut self.writes, &other.writes);
        unite(&mut self.looks, &other.looks);
    }

    /// The other one has to be first: it reads words as they are before this one.
    fn waits_for(&self, other: &Effect) -> bool {
        self.fills.is_some_and(|memory| other.looks[memory / 64] >> (memory % 64) & 1 == 1)
    }
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

    /// The registers and inputs that a value depends on.
    pub fn cone(&self, value: ValueId) -> &Set {
        &self.cones[value.index()]
    }

    /// The number of a register or input in a set.
    pub fn number(&self, stored: ValueId) -> Option<usize> {
        self.numbers.get(&stored).copied()
    }

    fn with_effect(&self, steps: Vec<Step>) -> (Vec<Step>, Effect) {
        let mut all = self.nothing();
        let mut open = Vec::new();
        for step in steps {
            let (step, effect) = match step {
                Step::If { bit, then } => {
                    let (then, mut effect) = self.with_effect(then);
                    unite(&mut effect.reads, &self.cones[bit.index()]);
                    (Step::If { bit, then }, effect)
                }
                Step::Unit { unit, then } => {
                    let (then, effect) = self.with_effect(then);
                    (Step::Unit { unit, then }, effect)
                }
                Step::Write(memory) => {
                    let mut effect = Effect { fills: Some(memory), ..self.nothing() };
                    let ports = self.design.memories[memory].writes.iter();
                    let values = ports.flat_map(|port| [port.en, port.addr, port.data]);
                    values.for_each(|value| unite(&mut effect.reads, &self.cones[value.index()]));
                    (Step::Write(memory), effect)
                }
                Step::Change(group) => {
                    let (group, effect) = self.of_group(group);
                    (Step::Change(group), effect)
                }
            };
            all.unite(&effect);
            open.push((step, effect));
        }
        (self.joined(sorted(open)), all)
    }

    /// Neighbours that change in every clock are one step: what they share stays in registers of the processor.
    fn joined(&self, steps: Vec<Step>) -> Vec<Step> {
        let always = |group: &Group| {
            group.conditions.len() == 1 && self.design.graph.as_constant(group.conditions[0]) == Some(1)
        };
        let mut joined: Vec<Step> = Vec::new();
        for step in steps {
            match (joined.last_mut(), step) {
                (Some(Step::Change(before)), Step::Change(group))
                    if always(before) && always(&group) && before.members.len() < MOST_JOINED =>
                {
                    before.members.extend(group.members);
                }
                (_, step) => joined.push(step),
            }
        }
        joined
    }

    /// The group with its members in a good order.
    fn of_group(&self, Group { unit, conditions, members }: Group) -> (Group, Effect) {
        let mut all = self.nothing();
        conditions.iter().for_each(|condition| unite(&mut all.reads, &self.cones[condition.index()]));
        let mut open = Vec::new();
        for member in members {
            let effect = self.of_member(&member);
            all.unite(&effect);
            open.push((member, effect));
        }
        (Group { unit, conditions, members: sorted(open) }, all)
    }

    fn of_member(&self, member: &Member) -> Effect {
        let mut effect = self.nothing();
        let mut read = |value: ValueId| unite(&mut effect.reads, &self.cones[value.index()]);
        match member {
            Member::Register { q, values } => {
                values.iter().copied().for_each(&mut read);
                self.insert(&mut effect.writes, *q);
            }
            Member::Read { memory, port } => {
                let port = self.design.memories[*memory].reads[*port];
                read(port.addr);
                self.insert(&mut effect.writes, port.q);
                effect.looks[memory / 64] |= 1 << (memory % 64);
            }
        }
        effect
    }

    fn nothing(&self) -> Effect {
        let looks = vec![0; self.design.memories.len().div_ceil(64)];
        Effect { reads: self.none(), writes: self.none(), looks, fills: None }
    }

    pub fn none(&self) -> Set {
        vec![0; self.numbers.len().div_ceil(64)]
    }

    fn insert(&self, set: &mut Set, stored: ValueId) {
        if let Some(number) = self.numbers.get(&stored) {
            set[number / 64] |= 1 << (number % 64);
        }
    }
}

/// Takes, again and again, the one that changes the fewest registers which others still have to read.
fn sorted<T>(mut open: Vec<(T, Effect)>) -> Vec<T> {
    let harm_of = |writer: &Effect| open.iter().map(|(_, other)| common(&writer.writes, &other.reads)).sum();
    let mut harm: Vec<u32> = open.iter().map(|(_, effect)| harm_of(effect)).collect();
    for (harm, (_, effect)) in harm.iter_mut().zip(&open) {
        *harm -= common(&effect.writes, &effect.reads); // no harm to itself
    }
    let mut order = Vec::new();
    while !open.is_empty() {
        let waits = |i: usize| open.iter().any(|(_, other)| open[i].1.waits_for(other));
        let next = (0..open.len()).filter(|i| !waits(*i)).min_by_key(|i| harm[*i]).unwrap_or(0);
        let (first, gone) = open.remove(next);
        harm.remove(next);
        for (harm, (_, effect)) in harm.iter_mut().zip(&open) {
            *harm -= common(&effect.writes, &gone.reads);
        }
        order.push(first);
    }
    order
}

pub(crate) fn unite(set: &mut Set, other: &Set) {
    set.iter_mut().zip(other).for_each(|(a, b)| *a |= b);
}

/// How many are in both.
fn common(a: &Set, b: &Set) -> u32 {
    a.iter().zip(b).map(|(a, b)| (a & b).count_ones()).sum()
}
