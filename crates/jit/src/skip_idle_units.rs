//! Units in which nothing can change are left out. What is computed from unchanged values comes out as it
//! was. So the steps of a unit can be left out when nothing that they read has changed for some clocks.
//!
//! Some registers of a unit, its **seeds**, are watched. They are chosen such that the others do not feed
//! themselves: no way leads from one of the others back to itself except through a seed. When seeds, inputs,
//! memories and what the unit reads from other units have not changed for a clock, the registers that follow
//! from them alone do not change in the next clock. A clock later those stay that follow from these, and
//! after as many clocks as the longest way has registers all of them stay.
//!
//! The state has a counter for each unit: the clocks for which the unit is to work on. A change of a watched
//! value sets the counter. Registers under a condition count as changed where the condition holds. Seeds that
//! are stored in every clock, or in an idle machine (`idle_state`), are **compared** with a copy of their
//! values. Seeds of the unit itself are compared all at once, and only when no other change has set the
//! counter for some clocks; while the unit has work, that is rare. Seeds of other units are compared where
//! they are stored. A bit that follows from other units alone, such as a `ready`, is a **gate**: it is
//! computed in every clock and watched in place of the registers behind it, which change more often. A
//! free-running register (`free_running`) is watched only while its mask is 1.

use std::collections::HashMap;

use crate::design::{Design, Runner};
use crate::effect::{Set, contains, insert, members, unite};
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::guard::{Literal, Needs};
use crate::idle_state::IdleState;
use crate::order::Readers;
use crate::step::Step;
use crate::wakes::{MOST, UNASKED, Wakes};

/// Clocks on the way to a seed at most; a unit of longer ways never stands still.
const LONGEST: usize = 100;

/// A register or a read port.
struct Node {
    unit: usize,
    q: ValueId,
    /// Number of the node in a set.
    number: usize,
    /// What it follows from.
    reads: Set,
    /// What must hold for it to change: the less, the more often it does.
    rarity: usize,
}

/// Which unit is woken by which change. The steps of the units get their gates.
pub(crate) fn wakes(design: &Design, readers: &Readers, groups: &[Group], steps: &mut [Step]) -> Wakes {
    let nodes = nodes(design, readers, groups);
    let units = nodes.iter().map(|node| node.unit + 1).max().unwrap_or(0);
    let none = vec![Vec::new(); units];
    let (stored, clocks) = (HashMap::new(), vec![0; units]);
    let masks = HashMap::new();
    let idle = IdleState::of(design);
    let mut wakes = Wakes { stored, masks, clocks, resting: 0, gates: none.clone(), compared: none, idle };
    let mut watched: Vec<(Set, usize)> = Vec::new();
    for unit in 0..units.min(MOST) {
        let own: Vec<&Node> = nodes.iter().filter(|node| node.unit == unit).collect();
        let (others, depth) = followers(readers, &own);
        let (mut reads, gates) = reads_of_unit(design, readers, groups, &own, unit);
        let runs = design.runners.iter().any(|runner| own.iter().any(|node| node.q == runner.q));
        if depth <= LONGEST && !own.is_empty() && !runs {
            // One clock for seeds that follow from the others, one for a change earlier in the same clock,
            // one to be safe.
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
    compare(&mut wakes, design, steps);
    let Wakes { clocks, compared, .. } = &mut wakes;
    let none_asked =
        clocks.iter_mut().zip(compared).filter(|(clocks, seeds)| **clocks > 0 && seeds.is_empty());
    none_asked.for_each(|(clocks, _)| *clocks -= UNASKED);
    for step in steps {
        if let Step::Unit { unit, gates, .. } = step {
            *gates = wakes.gates(*unit).to_vec();
        }
    }
    wakes
}

/// The registers of these steps that change in an idle machine have to be compared.
fn compare(wakes: &mut Wakes, design: &Design, steps: &[Step]) {
    for step in steps {
        match step {
            Step::Change(group) if group.conditions.iter().any(|when| wakes.is_idle(*when)) => {
                let qs = group.members.iter().map(|member| member.q(design));
                let seeds: Vec<ValueId> = qs.filter(|q| wakes.of(*q) & wakes.own(group.unit) != 0).collect();
                wakes.compared[group.unit].extend(seeds);
            }
            Step::Change(_) | Step::Write(_) | Step::Early(_) => {}
            Step::If { bit, .. } if !wakes.is_idle(*bit) => {}
            Step::Unit { then, .. } | Step::If { then, .. } => compare(wakes, design, then),
        }
    }
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

/// Registers of a unit that need not be watched, as many as there are among those that change most often; and
/// of how many the longest way among them is.
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

/// Registers of the set on the longest way to this one, itself too; more than `LONGEST` where it is longer
/// than that. The one that was asked for is so many registers ahead.
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

/// All that the steps of a unit read: registers and inputs; and in place of those of others the bits that
/// conditions ask for.
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
