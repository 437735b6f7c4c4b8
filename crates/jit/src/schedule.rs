//! A clock as nested branches: groups that change only if the same bit is 1 stand in one block, which is
//! skipped if it is 0.

use std::collections::{BTreeMap, BTreeSet};

use edgewalk_netlist::Op;

use crate::design::{Design, Memory};
use crate::graph::{Graph, ValueId};
use crate::groups::{Group, Member};
use crate::guard::{Literal, Needs};
use crate::step::Step;

/// What a clock does to registers and read ports. It adds values to the graph: the conditions of branches.
pub(crate) fn schedule(design: &mut Design, groups: &[Group]) -> Vec<Step> {
    let always = Literal { bit: design.graph.constant(1, 1), high: true };
    let mut nesting = Nesting { graph: &mut design.graph, needs: Needs::default(), asked: vec![always] };
    let units =
        groups.iter().map(|group| group.unit).chain(design.memories.iter().map(|memory| memory.unit)).max();
    let mut steps = Vec::new();
    for unit in 0..=units.unwrap_or(0) {
        let of_unit = groups.iter().filter(|group| group.unit == unit);
        let open = of_unit.map(|group| nesting.open(group.clone())).collect();
        let mut then = nesting.by_choice(open);
        let written = |(_, memory): &(usize, &Memory)| memory.unit == unit && !memory.writes.is_empty();
        then.extend(
            design.memories.iter().enumerate().filter(written).map(|(memory, _)| Step::Write(memory)),
        );
        if !then.is_empty() {
            steps.push(Step::Unit { unit, gates: Vec::new(), then });
        }
    }
    steps
}

/// A group, and what each of its conditions needs.
struct Open {
    group: Group,
    needs: Vec<BTreeSet<Literal>>,
}

impl Open {
    /// The group changes only if one of these holds.
    fn is_within(&self, choice: &BTreeSet<Literal>) -> bool {
        self.needs.iter().all(|needs| !needs.is_disjoint(choice))
    }
}

/// Blocks in blocks.
struct Nesting<'d> {
    graph: &'d mut Graph,
    needs: Needs,
    /// What holds where the block is reached.
    asked: Vec<Literal>,
}

impl Nesting<'_> {
    fn open(&mut self, group: Group) -> Open {
        let literals = group.conditions.iter().map(|condition| Literal::of(self.graph, *condition));
        let needs = literals.map(|literal| self.needs.of(self.graph, literal)).collect();
        Open { group, needs }
    }

    /// Groups under a choice, such as `load | step`, share a block; those left over may share a literal.
    fn by_choice(&mut self, mut open: Vec<Open>) -> Vec<Step> {
        let mut steps = Vec::new();
        while let Some(choice) = widest_choice(self.graph, &open) {
            let (inside, outside) = open.into_iter().partition(|o| o.is_within(&choice));
            open = outside;
            let then = self.by_literal(inside);
            let bits: Vec<ValueId> = choice.iter().map(|literal| literal.value(self.graph)).collect();
            let none = self.graph.constant(1, 0);
            let bit = bits.iter().fold(none, |any, bit| self.graph.op(Op::Or, 1, &[any, *bit]));
            steps.push(Step::If { bit, then });
        }
        steps.extend(self.by_literal(open));
        steps
    }

    /// Groups of which all conditions need the same literal share a block.
    fn by_literal(&mut self, mut open: Vec<Open>) -> Vec<Step> {
        let mut steps = Vec::new();
        while let Some(literal) = most_shared(&open, &self.asked) {
            let choice = BTreeSet::from([literal]);
            let (inside, outside) = open.into_iter().partition(|o| o.is_within(&choice));
            open = outside;
            let before = self.asked.len();
            self.asked.extend(self.needs.of(self.graph, literal));
            let then = self.by_literal(inside);
            self.asked.truncate(before);
            steps.push(Step::If { bit: literal.value(self.graph), then });
        }
        let groups = open.into_iter().map(|o| self.simplified(o.group)).collect();
        steps.extend(joined(groups).into_iter().map(Step::Change));
        steps
    }

    /// The group with conditions that do not ask again what is known to hold.
    fn simplified(&mut self, mut group: Group) -> Group {
        for condition in &mut group.conditions {
            if self.asked.contains(&Literal::of(self.graph, *condition)) {
                *condition = self.graph.constant(1, 1);
            }
        }
        group
    }
}

/// What changes under one condition joins a group in which that is the strongest, so that it is asked once.
fn joined(groups: Vec<Group>) -> Vec<Group> {
    let (mut several, single): (Vec<Group>, Vec<Group>) =
        groups.into_iter().partition(|group| group.conditions.len() > 1);
    let mut left = Vec::new();
    for group in single {
        let has_reads = group.members.iter().any(|member| matches!(member, Member::Read { .. }));
        let joins = |other: &&mut Group| !has_reads && other.conditions.last() == group.conditions.last();
        match several.iter_mut().find(joins) {
            Some(other) => {
                let weaker = other.conditions.len() - 1;
                other.members.extend(group.members.into_iter().map(|member| member.kept(weaker)));
            }
            None => left.push(group),
        }
    }
    several.extend(left);
    several
}

/// Of the conditions of the groups that have several, those within which most groups change. One that always
/// holds is no choice: all that changes in every clock would be within it, apart from the rest. Two groups
/// are too few to ask for once more.
fn widest_choice(graph: &Graph, open: &[Open]) -> Option<BTreeSet<Literal>> {
    let several =
        open.iter().filter(|o| o.needs.len() > 1 && shared(o).is_empty() && !o.group.is_unconditional(graph));
    let choices = several.map(|o| o.group.conditions.iter().map(|c| Literal::of(graph, *c)).collect());
    let within = |choice: &BTreeSet<Literal>| open.iter().filter(|o| o.is_within(choice)).count();
    let widest = choices.map(|choice| (within(&choice), choice)).max_by_key(|(count, _)| *count);
    widest.filter(|(count, _)| *count > 2).map(|(_, choice)| choice)
}

/// The literal that most groups need and that is not asked yet, if more than one does.
fn most_shared(open: &[Open], asked: &[Literal]) -> Option<Literal> {
    let mut groups: BTreeMap<Literal, usize> = BTreeMap::new();
    for literal in open.iter().flat_map(shared) {
        *groups.entry(literal).or_default() += 1;
    }
    // Of equals the last: it was computed from the others and says most.
    let open = groups.into_iter().filter(|(literal, count)| *count > 1 && !asked.contains(literal));
    open.max_by_key(|(_, count)| *count).map(|(literal, _)| literal)
}

/// What all conditions of a group need.
fn shared(open: &Open) -> BTreeSet<Literal> {
    let all = open.needs.iter().cloned().reduce(|all, needs| all.intersection(&needs).copied().collect());
    all.unwrap_or_default()
}
