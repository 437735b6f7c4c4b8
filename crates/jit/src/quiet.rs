//! Units that stand still. What is computed of nothing but what is as it was comes out as it was; so the steps of a unit can be
//! left out when nothing that they read has changed for some clocks.
//!
//! Some registers of a unit, its **seeds**, are watched, such that the others do not feed themselves: nothing leads from one of
//! them to itself but through a seed. When seeds, inputs, memories and what the unit reads of others have not changed for a
//! clock, then in the next clock those others stay that follow from them alone, a clock later those that follow from these,
//! and after as many clocks as the longest way has registers all of them.
//!
//! The state has a counter for each unit, the clocks for which it is to work on. Whoever changes something that is watched sets
//! the counter: registers under a condition count as changed where it holds. Seeds that are stored in every clock, or while nothing
//! is to be done (`idle`), are **compared**: with a copy of what they were, all of the unit at once, and only when no other change
//! has set the counter for some clocks, which is seldom while the unit has work; those of other units where they are stored. A bit
//! that follows from other units alone, as a `ready` does, is a **gate**: it is worked out in every clock and watched in place of
//! the registers behind it, which change more often. A runner (`apart`) is watched only while its mask is 1.

use std::collections::HashMap;

use crate::design::{Design, Runner};
use crate::effect::{Set, unite};
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::guard::{Literal, Needs};
use crate::idle::Idle;
use crate::order::Readers;
use crate::step::Step;

/// Units with a counter, a bit each in a set of units; those beyond them never stand still.
pub(crate) const MOST: usize = 64;

/// Clocks on the way to a seed at most; a unit of longer ways never stands still.
const LONGEST: usize = 100;

/// Clocks after a change for which a unit's own seeds are not compared: most often the next change comes within them.
const UNASKED: u8 = 4;

/// Who has to know of a change, and for how long.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wakes {
    /// The units that have to know that a register or an input has changed.
    stored: HashMap<ValueId, u64>,
    /// Of each runner its mask, and the unit that has to know of it while the mask is 1.
    masks: HashMap<ValueId, (ValueId, u64)>,
    /// Of each unit, the clocks that it works on after a change; 0 for one that never stands still.
    pub clocks: Vec<u8>,
    /// The units that can.
    resting: u64,
    /// Of each unit.
    gates: Vec<Vec<ValueId>>,
    /// Of each unit, its own seeds that are compared.
    compared: Vec<Vec<ValueId>>,
    idle: Idle,
}

impl Wakes {
    /// The units that have to know that this register or input has changed.
    pub fn of(&self, stored: ValueId) -> u64 {
        self.stored.get(&stored).copied().unwrap_or(0)
    }

    /// The mask of a runner, and the unit that works on while it is 1.
    pub fn mask(&self, runner: ValueId) -> Option<(ValueId, u64)> {
        self.masks.get(&runner).copied()
    }

    /// Whether the unit can stand still.
    pub fn rests(&self, unit: usize) -> bool {
        self.clocks.get(unit).is_some_and(|clocks| *clocks > 0)
    }

    /// The gates of a unit.
    pub fn gates(&self, unit: usize) -> &[ValueId] {
        self.gates.get(unit).map_or(&[], Vec::as_slice)
    }

    /// The gates of all units.
    pub fn all_gates(&self) -> Vec<ValueId> {
        self.gates.concat()
    }

    /// The seeds of a unit that are compared with what they were.
    pub fn compared(&self, unit: usize) -> &[ValueId] {
        self.compared.get(unit).map_or(&[], Vec::as_slice)
    }

    /// The largest counter with which they are: all that follow are clocks without any other change. In the first of them there
    /// is no clock before to compare with.
    pub fn asked_from(&self, unit: usize) -> u8 {
        self.clocks[unit] - UNASKED
    }

    /// Whether the condition holds while nothing is to be done. What changes under it, and within no other one, is compared with
    /// what it was; else it counts as changed.
    pub fn is_idle(&self, condition: ValueId) -> bool {
        self.idle.holds(condition)
    }

    /// The registers of these steps that change while nothing is to be done have to be compared.
    fn compare(&mut self, design: &Design, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Change(group) if group.conditions.iter().any(|when| self.is_idle(*when)) => {
                    let qs = group.members.iter().map(|member| member.q(design));
                    let seeds: Vec<ValueId> =
                        qs.filter(|q| self.of(*q) & self.own(group.unit) != 0).collect();
                    self.compared[group.unit].extend(seeds);
                }
                Step::Change(_) | Step::Write(_) | Step::Early(_) => {}
                Step::If { bit, .. } if !self.is_idle(*bit) => {}
                Step::Unit { then, .. } | Step::If { then, .. } => self.compare(design, then),
            }
        }
    }

    /// The set of a unit alone; none if it never stands still.
    pub fn own(&self, unit: usize) -> u64 {
        self.resting & 1u64.checked_shl(unit as u32).unwrap_or(0)
    }

    /// The units of a set that can stand still, with their clocks.
    pub fn units(&self, set: u64) -> impl Iterator<Item = (usize, u8)> {
        let mut left = set & self.resting;
        std::iter::from_fn(move || {
            let unit = left.trailing_zeros() as usize;
            (left != 0).then(|| {
                left &= left - 1;
                (unit, self.clocks[unit])
            })
        })
    }
}

/// A register or a read port.
struct Node {
    unit: usize,
    q: ValueId,
    /// Its number in a set.
    number: usize,
    /// What it follows from.
    reads: Set,
    /// What must hold for it to change: the less, the more often it does.
    rarity: usize,
}

/// Who has to know of which change.
pub(crate) fn wakes(design: &Design, readers: &Readers, groups: &[Group], steps: &[Step]) -> Wakes {
    let nodes = nodes(design, readers, groups);
    let units = nodes.iter().map(|node| node.unit + 1).max().unwrap_or(0);
    let none = vec![Vec::new(); units];
    let (stored, clocks) = (HashMap::new(), vec![0; units]);
    let masks = HashMap::new();
    let idle = Idle::of(design);
    let mut wakes = Wakes { stored, masks, clocks, resting: 0, gates: none.clone(), compared: none, idle };
    let mut watched: Vec<(Set, usize)> = Vec::new();
    for unit in 0..units.min(MOST) {
        let own: Vec<&Node> = nodes.iter().filter(|node| node.unit == unit).collect();
        let (others, depth) = followers(readers, &own);
        let (mut reads, gates) = reads_of_unit(design, readers, groups, &own, unit);
        let runs = design.runners.iter().any(|runner| own.iter().any(|node| node.q == runner.q));
        if depth <= LONGEST && !own.is_empty() && !runs {
            // One clock for seeds that follow from the others, one for a change earlier in the same clock, one to be safe.
            wakes.clocks[unit] = depth as u8 + 3 + UNASKED;
            wakes.resting |= 1 << unit;
            wakes.gates[unit] = gates;
            reads.iter_mut().zip(&others).for_each(|(reads, other)| *reads &= !other);
            for Runner { q, mask, .. } in design.runners.iter().filter(|runner| runner.sees == unit) {
                readers.number(*q).into_iter().for_each(|number| reads[number / 64] &= !(1 << (number % 64)));
                wakes.masks.insert(*q, (*mask, 1 << unit));
            }
            watched.push((reads, unit));
        }
    }
    let graph = &design.graph;
    for id in graph.ids().filter(|id| *graph.kind(*id) == Kind::Stored) {
        let Some(number) = readers.number(id) else { continue };
        let units = watched.iter().filter(|(reads, _)| contains(reads, number));
        wakes.stored.insert(id, units.fold(0, |all, (_, unit)| all | 1 << unit));
    }
    wakes.compare(design, steps);
    let Wakes { clocks, compared, .. } = &mut wakes;
    let none_asked =
        clocks.iter_mut().zip(compared).filter(|(clocks, seeds)| **clocks > 0 && seeds.is_empty());
    none_asked.for_each(|(clocks, _)| *clocks -= UNASKED);
    wakes
}

fn nodes(design: &Design, readers: &Readers, groups: &[Group]) -> Vec<Node> {
    let graph: &Graph = &design.graph;
    let mut needs = Needs::default();
    let mut nodes = Vec::new();
    for group in groups {
        let mut asked = readers.none();
        group.conditions.iter().for_each(|condition| unite(&mut asked, readers.cone(*condition)));
        let always = |condition: &ValueId| graph.as_constant(*condition) == Some(1);
        let literals = group.conditions.iter().filter(|condition| !always(condition));
        let rarity = literals.map(|condition| needs.of(graph, Literal::of(graph, *condition)).len()).min();
        let rarity = if always(&group.conditions[0]) { 0 } else { rarity.unwrap_or(0) };
        for member in &group.members {
            let mut reads = asked.clone();
            let q = match member {
                Member::Register { q, values } => {
                    values.iter().for_each(|value| unite(&mut reads, readers.cone(*value)));
                    *q
                }
                Member::Read { memory, port } => {
                    let port = design.memories[*memory].reads[*port];
                    unite(&mut reads, readers.cone(port.addr));
                    port.q
                }
            };
            if let Some(number) = readers.number(q) {
                nodes.push(Node { unit: group.unit, q, number, reads, rarity });
            }
        }
    }
    nodes
}

/// Registers of a unit that need not be watched, as many as there are among those that change most often; and of how many the
/// longest way among them is.
fn followers(readers: &Readers, own: &[&Node]) -> (Set, usize) {
    let by_number: HashMap<usize, &Node> = own.iter().map(|node| (node.number, *node)).collect();
    let mut order: Vec<&Node> = own.to_vec();
    order.sort_by_key(|node| (node.rarity, node.q));
    let mut set = readers.none();
    for node in order {
        insert(&mut set, node.number);
        if feeds_itself(&by_number, &set, node, readers.none()) {
            set[node.number / 64] &= !(1 << (node.number % 64));
        }
    }
    let mut depths: HashMap<usize, usize> = HashMap::new();
    for node in own {
        depth(&by_number, &set, node, 0, &mut depths);
    }
    (set, depths.values().copied().max().unwrap_or(0))
}

/// Whether a way leads from the register to itself within the set.
fn feeds_itself(by_number: &HashMap<usize, &Node>, set: &Set, node: &Node, mut seen: Set) -> bool {
    let mut open = vec![node];
    while let Some(at) = open.pop() {
        if contains(&at.reads, node.number) {
            return true;
        }
        for number in members(&at.reads, set) {
            if !contains(&seen, number)
                && let Some(next) = by_number.get(&number)
            {
                insert(&mut seen, number);
                open.push(next);
            }
        }
    }
    false
}

/// Registers of the set on the longest way to this one, itself too; more than `LONGEST` where it is longer than that. The one
/// that was asked for is so many registers ahead.
fn depth(
    by_number: &HashMap<usize, &Node>,
    set: &Set,
    node: &Node,
    ahead: usize,
    known: &mut HashMap<usize, usize>,
) -> usize {
    if !contains(set, node.number) {
        return 0;
    }
    if ahead > LONGEST {
        return ahead; // it calls itself no deeper
    }
    if let Some(depth) = known.get(&node.number) {
        return *depth;
    }
    let before: Vec<&Node> =
        members(&node.reads, set).filter_map(|number| by_number.get(&number).copied()).collect();
    let longest = before.into_iter().map(|before| depth(by_number, set, before, ahead + 1, known)).max();
    let depth = longest.unwrap_or(0) + 1;
    known.insert(node.number, depth);
    depth
}

/// All that the steps of a unit read: registers and inputs; and in place of those of others the bits that conditions ask for.
fn reads_of_unit(
    design: &Design,
    readers: &Readers,
    groups: &[Group],
    own: &[&Node],
    unit: usize,
) -> (Set, Vec<ValueId>) {
    let graph = &design.graph;
    let mut inside = readers.none();
    own.iter().for_each(|node| insert(&mut inside, node.number));
    let mut inputs = readers.none();
    design
        .inputs
        .values()
        .filter_map(|input| readers.number(*input))
        .for_each(|number| insert(&mut inputs, number));
    let is_gate = |value: ValueId| {
        let cone = readers.cone(value);
        let of_others = cone.iter().zip(&inputs).map(|(cone, inputs)| (cone & !inputs).count_ones());
        graph.width(value) == 1 && of_others.sum::<u32>() > 1 && members(cone, &inside).next().is_none()
    };
    let (mut asked, mut stored): (Vec<ValueId>, Vec<ValueId>) = (Vec::new(), Vec::new());
    for group in groups.iter().filter(|group| group.unit == unit) {
        asked.extend(&group.conditions);
        for member in &group.members {
            match member {
                Member::Register { values, .. } => stored.extend(values),
                Member::Read { memory, port } => stored.push(design.memories[*memory].reads[*port].addr),
            }
        }
    }
    for port in design.memories.iter().filter(|memory| memory.unit == unit).flat_map(|memory| &memory.writes)
    {
        asked.push(port.en);
        stored.extend([port.addr, port.data]);
    }
    let (mut reads, mut gates, mut seen) = (readers.none(), Vec::new(), vec![false; graph.len()]);
    for (mut open, asks) in [(asked, true), (stored, false)] {
        while let Some(value) = open.pop() {
            if std::mem::replace(&mut seen[value.index()], true) {
                continue;
            }
            if let Some(number) = readers.number(value) {
                insert(&mut reads, number);
            } else if asks && is_gate(value) {
                gates.push(value);
            } else {
                open.extend(graph.operands(value));
            }
        }
    }
    (reads, gates)
}

fn members<'s>(a: &'s Set, b: &'s Set) -> impl Iterator<Item = usize> + 's {
    let both = a.iter().zip(b).map(|(a, b)| a & b).enumerate();
    both.flat_map(|(word, bits)| {
        (0..64).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| word * 64 + bit)
    })
}

fn contains(set: &Set, number: usize) -> bool {
    set[number / 64] >> (number % 64) & 1 == 1
}

fn insert(set: &mut Set, number: usize) {
    set[number / 64] |= 1 << (number % 64);
}
