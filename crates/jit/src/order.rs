//! The order of steps. A register is best read before it changes: otherwise its old value must be kept for
//! the steps that read it later.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::design::Design;
use crate::effect::{Effect, Set, unite};
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::sorted::sorted;
use crate::step::Step;

/// Registers of a step that change in every clock; more at once would not find room in the processor.
const MOST_JOINED: usize = 16;

/// A condition that a unit asks in every clock is worked out early if it follows from so many registers or
/// more: they need not stay for it then.
const MANY: u32 = 8;

/// Which registers and inputs each value depends on.
pub(crate) struct Readers<'d> {
    design: &'d Design,
    /// The number of each stored value in a [`Set`].
    numbers: HashMap<ValueId, usize>,
    cones: Vec<Set>,
    /// Like `cones`, once what is early has been worked out.
    left: Vec<Set>,
    /// What is early in a unit.
    early: BTreeMap<usize, Vec<ValueId>>,
}

impl<'d> Readers<'d> {
    /// From the operands on.
    pub fn of(design: &'d Design, steps: &[Step]) -> Readers<'d> {
        let graph: &Graph = &design.graph;
        let stored = graph.ids().filter(|id| *graph.kind(*id) == Kind::Stored);
        let numbers = stored.enumerate().map(|(number, id)| (id, number)).collect();
        let mut readers =
            Readers { design, numbers, cones: Vec::new(), left: Vec::new(), early: BTreeMap::new() };
        readers.cones = readers.cones_but(&BTreeSet::new());
        for step in steps {
            if let Step::Unit { unit, then, .. } = step {
                readers.early.insert(*unit, readers.early_of(then));
            }
        }
        readers.left = readers.cones_but(&readers.early.values().flatten().copied().collect());
        readers
    }

    /// What each value depends on, but for what it depends on through these.
    fn cones_but(&self, known: &BTreeSet<ValueId>) -> Vec<Set> {
        let graph = &self.design.graph;
        let mut cones: Vec<Set> = Vec::with_capacity(graph.len());
        for id in graph.ids() {
            let mut set = self.none();
            self.insert(&mut set, id);
            if !known.contains(&id) {
                graph.operands(id).iter().for_each(|operand| unite(&mut set, &cones[operand.index()]));
            }
            cones.push(set);
        }
        cones
    }

    /// Conditions that these steps ask whenever they are reached, and that follow from many registers.
    fn early_of(&self, steps: &[Step]) -> Vec<ValueId> {
        let asked = steps.iter().flat_map(|step| match step {
            Step::Change(group) => group.conditions.as_slice(),
            Step::If { bit, .. } => std::slice::from_ref(bit),
            _ => &[],
        });
        let many =
            |bit: &&ValueId| self.cone(**bit).iter().map(|word| word.count_ones()).sum::<u32>() >= MANY;
        let early: BTreeSet<ValueId> = asked.filter(many).copied().collect();
        early.into_iter().collect()
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
                    unite(&mut effect.reads, &self.left[bit.index()]);
                    (Step::If { bit, then }, effect)
                }
                Step::Early(bits) => (Step::Early(bits), self.nothing()),
                Step::Unit { unit, gates, then } => {
                    let (mut then, mut effect) = self.with_effect(then);
                    let early = self.early.get(&unit).cloned().unwrap_or_default();
                    if !early.is_empty() {
                        early.iter().for_each(|bit| unite(&mut effect.reads, self.cone(*bit)));
                        then.insert(0, Step::Early(early));
                    }
                    (Step::Unit { unit, gates, then }, effect)
                }
                Step::Write(memory) => {
                    let mut effect = Effect { fills: Some(memory), ..self.nothing() };
                    let ports = self.design.memories[memory].writes.iter();
                    let values = ports.flat_map(|port| [port.en, port.addr, port.data]);
                    values.for_each(|value| unite(&mut effect.reads, &self.left[value.index()]));
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

    /// Neighbours that change in every clock are one step: what they share stays in registers of the
    /// processor.
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
        conditions.iter().for_each(|condition| unite(&mut all.reads, &self.left[condition.index()]));
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
        let mut read = |value: ValueId| unite(&mut effect.reads, &self.left[value.index()]);
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
