//! Values that several steps of a clock need: they are kept in the state from the first that needs them on. In a register of
//! the processor they would not stay till then.

use crate::design::Design;
use crate::graph::{Kind, ValueId};
use crate::groups::{Group, Member};
use crate::quiet::Wakes;
use crate::step::Step;
use crate::tables::Tables;

/// The values that are needed again after the step that works them out.
pub(crate) fn shared(design: &Design, tables: &Tables, wakes: &Wakes, steps: &[Step]) -> Vec<ValueId> {
    let mut walk =
        Walk { design, tables, wakes, known: vec![0; design.graph.len()], step: 1, shared: Vec::new() };
    design.outputs.iter().for_each(|(_, value)| walk.need(*value));
    walk.steps(steps);
    walk.shared.sort_unstable();
    walk.shared.dedup();
    walk.shared
}

/// The way through a clock.
struct Walk<'d> {
    design: &'d Design,
    tables: &'d Tables,
    wakes: &'d Wakes,
    /// The step in which each value was worked out; 0 if it is not known here.
    known: Vec<u32>,
    step: u32,
    shared: Vec<ValueId>,
}

impl Walk<'_> {
    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            self.step += 1;
            match step {
                Step::Change(group) => self.change(group, group.conditions.len()),
                Step::Write(memory) => {
                    for port in &self.design.memories[*memory].writes {
                        self.need(port.en);
                        self.aside(|walk| {
                            [port.addr, port.data].into_iter().for_each(|value| walk.need(value))
                        });
                    }
                }
                Step::Unit { unit, then } => {
                    self.wakes.gates(*unit).iter().for_each(|gate| self.need(*gate));
                    self.aside(|walk| walk.steps(then));
                }
                Step::If { bit, then } => {
                    self.need(*bit);
                    self.aside(|walk| walk.steps(then));
                }
            }
        }
    }

    fn change(&mut self, group: &Group, rank: usize) {
        let Some(rank) = rank.checked_sub(1) else { return };
        if self.design.graph.as_constant(group.conditions[rank]) == Some(1) {
            return self.take(group, rank);
        }
        self.need(group.conditions[rank]);
        self.aside(|walk| walk.take(group, rank));
        self.aside(|walk| walk.change(group, rank));
    }

    fn take(&mut self, group: &Group, rank: usize) {
        for member in &group.members {
            self.need(match member {
                Member::Register { values, .. } => values[rank],
                Member::Read { memory, port } => self.design.memories[*memory].reads[*port].addr,
            });
        }
    }

    /// What is worked out in a branch is known in it only.
    fn aside(&mut self, branch: impl FnOnce(&mut Self)) {
        let known = self.known.clone();
        branch(self);
        self.known = known;
    }

    fn need(&mut self, value: ValueId) {
        let mut open = vec![value];
        while let Some(value) = open.pop() {
            if !matches!(self.design.graph.kind(value), Kind::Op(..)) {
                continue;
            }
            let known = &mut self.known[value.index()];
            if *known != 0 {
                if *known != self.step {
                    self.shared.push(value);
                }
                continue;
            }
            if self.tables.get(value).is_none() {
                *known = self.step;
            }
            open.extend(self.tables.operands(&self.design.graph, value));
        }
    }
}
