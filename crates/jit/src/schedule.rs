//! A clock as nested branches: groups whose conditions all need the same literal stand in one block, which is skipped
//! when the literal does not hold.

use std::collections::BTreeMap;

use crate::design::Design;
use crate::graph::{Graph, ValueId};
use crate::groups::{Group, groups};
use crate::guard::{Guard, Literal};
use crate::order::Readers;

/// A step of a clock.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// What changes under conditions.
    Change(Group),
    /// Steps for when this bit is 1.
    If { bit: ValueId, then: Vec<Step> },
}

/// What a clock does to registers and read ports. It adds values to the graph: conditions without what a branch around
/// them has asked already.
pub(crate) fn schedule(design: &mut Design) -> Vec<Step> {
    let groups = groups(design);
    let needed = |group: Group| {
        let guards = group.conditions.iter().map(|condition| Guard::of(&design.graph, *condition));
        let guard = guards.reduce(|all, guard| all.common(&guard)).unwrap_or_default();
        Open { group, guard }
    };
    let open = groups.into_iter().map(needed).collect();
    let steps = nested(&mut design.graph, open, &mut Vec::new());
    Readers::of(design).ordered(steps)
}

/// A group, and what must hold for it to change that no branch around it has asked yet.
struct Open {
    group: Group,
    guard: Guard,
}

/// The steps of a block that is reached only if the literals of `asked` hold.
fn nested(graph: &mut Graph, mut open: Vec<Open>, asked: &mut Vec<Literal>) -> Vec<Step> {
    let mut steps = Vec::new();
    while let Some(literal) = most_shared(&open) {
        let (inside, outside): (Vec<Open>, Vec<Open>) = open.into_iter().partition(|o| o.guard.has(&literal));
        asked.push(literal);
        let inside = inside.into_iter().map(|o| Open { guard: o.guard.without(asked), ..o }).collect();
        let then = nested(graph, inside, asked);
        asked.pop();
        steps.push(Step::If { bit: literal.value(graph), then });
        open = outside;
    }
    steps.extend(open.into_iter().map(|o| Step::Change(simplified(graph, o.group, asked))));
    steps
}

/// The literal that most groups need, if more than one does.
fn most_shared(open: &[Open]) -> Option<Literal> {
    let mut groups: BTreeMap<Literal, usize> = BTreeMap::new();
    for literal in open.iter().flat_map(|o| o.guard.literals()) {
        *groups.entry(*literal).or_default() += 1;
    }
    // Of equals the first: what is computed from less.
    let most = groups.into_iter().rev().max_by_key(|(_, count)| *count);
    most.filter(|(_, count)| *count > 1).map(|(literal, _)| literal)
}

/// The group with conditions that do not ask again what is known to hold.
fn simplified(graph: &mut Graph, mut group: Group, asked: &[Literal]) -> Group {
    for condition in &mut group.conditions {
        let guard = Guard::of(graph, *condition);
        let rest = guard.without(asked);
        if rest != guard {
            *condition = rest.value(graph);
        }
    }
    group
}
