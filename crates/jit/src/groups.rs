//! Groups of registers and read ports that change under the same conditions. A group shares the branches of a clock; values that only
//! its members need are computed only when they change.

use std::collections::HashMap;

use crate::design::{Design, Register};
use crate::graph::{Graph, ValueId};

/// Conditions and what changes under them.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// All members are of this unit.
    pub unit: usize,
    /// One bit each, the strongest last; the last one that holds decides, and if none does nothing changes.
    pub conditions: Vec<ValueId>,
    pub members: Vec<Member>,
}

impl Group {
    /// All members change whenever it is reached.
    pub fn is_unconditional(&self, graph: &Graph) -> bool {
        graph.as_constant(self.conditions[0]) == Some(1)
    }
}

/// What changes.
#[derive(Clone, Debug)]
pub(crate) enum Member {
    /// A register takes the value of the condition that decides; it stays where that is itself.
    Register { q: ValueId, values: Vec<ValueId> },
    /// A memory's read port, which has one condition, takes a word.
    Read { memory: usize, port: usize },
}

impl Member {
    /// The register, or the output of the read port.
    pub fn q(&self, design: &Design) -> ValueId {
        match self {
            Member::Register { q, .. } => *q,
            Member::Read { memory, port } => design.memories[*memory].reads[*port].q,
        }
    }

    /// Whether it stays under the condition of this rank.
    pub fn stays(&self, rank: usize) -> bool {
        matches!(self, Member::Register { q, values } if values[rank] == *q)
    }

    /// Like `stays`, staying under so many conditions more, which are weaker; a read port has only one.
    pub fn kept(self, weaker: usize) -> Member {
        match self {
            Member::Register { q, values } => {
                Member::Register { q, values: std::iter::repeat_n(q, weaker).chain(values).collect() }
            }
            read => read,
        }
    }
}

/// The groups of all registers and read ports, those of a unit and of equal conditions together.
pub(crate) fn groups(design: &mut Design) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut known: HashMap<(usize, Vec<ValueId>), usize> = HashMap::new();
    let mut add = |graph: &Graph, unit, conditions: Vec<ValueId>, member| {
        if graph.as_constant(conditions[0]) == Some(1) && conditions.len() == 1 {
            return groups.push(Group { unit, conditions, members: vec![member] });
        }
        let group = *known.entry((unit, conditions.clone())).or_insert_with(|| {
            groups.push(Group { unit, conditions, members: Vec::new() });
            groups.len() - 1
        });
        groups[group].members.push(member);
    };
    let Design { graph, registers, memories, .. } = design;
    for register in registers.iter() {
        let (conditions, values) = updates(graph, register);
        if !conditions.is_empty() {
            add(graph, register.unit, conditions, Member::Register { q: register.q, values });
        }
    }
    for (memory, ports) in memories.iter().enumerate() {
        for (port, read) in ports.reads.iter().enumerate() {
            if graph.as_constant(read.en) != Some(0) {
                add(graph, ports.unit, vec![read.en], Member::Read { memory, port });
            }
        }
    }
    groups
}

/// The updates that can decide: not those under a 0, nor those that one under a 1 always overrules.
fn updates(graph: &mut Graph, register: &Register) -> (Vec<ValueId>, Vec<ValueId>) {
    let always = graph.constant(1, 1);
    let all = register.updates.iter().map(|(when, value)| (when.unwrap_or(always), *value));
    let all: Vec<_> = all.filter(|(when, _)| graph.as_constant(*when) != Some(0)).collect();
    let first = all.iter().rposition(|(when, _)| *when == always).unwrap_or(0);
    all[first..].iter().copied().unzip()
}
