//! Values that several steps of a clock need. They are kept in the state from the first of these steps on: in
//! a register of the processor they would not survive that long.

use edgewalk_netlist::Op;

use crate::design::Design;
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::sink::{Choice, Sink};
use crate::step::Step;
use crate::tables::Tables;

/// The values that are needed again after the step that works them out.
pub(crate) fn shared(design: &Design, tables: &Tables, steps: &[Step]) -> Vec<ValueId> {
    let known = vec![0; design.graph.len()];
    let (sink, undo, shared) = (Sink::new(&design.graph), Vec::new(), Vec::new());
    let mut walk = Walk { design, tables, sink, known, undo, step: 1, shared };
    let outputs: Vec<ValueId> = design.outputs.iter().map(|(_, value)| *value).collect();
    walk.look(outputs.clone());
    outputs.into_iter().for_each(|value| walk.need(value));
    walk.steps(steps);
    walk.shared.sort_unstable();
    walk.shared.dedup();
    walk.shared
}

/// The way through a clock.
struct Walk<'d> {
    design: &'d Design,
    tables: &'d Tables,
    sink: Sink,
    /// The step in which each value was worked out; 0 if it is not known here.
    known: Vec<u32>,
    /// What was known before, since the outermost branch began.
    undo: Vec<(ValueId, u32)>,
    step: u32,
    shared: Vec<ValueId>,
}

impl Walk<'_> {
    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            self.step += 1;
            self.look(step.asked(self.design));
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
                Step::Early(bits) => bits.iter().for_each(|bit| self.need(*bit)),
                Step::Unit { gates, then, .. } => {
                    gates.iter().for_each(|gate| self.need(*gate));
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
        let mark = self.undo.len();
        branch(self);
        for (value, before) in self.undo.drain(mark..).rev() {
            self.known[value.index()] = before;
        }
    }

    fn look(&mut self, asked: Vec<ValueId>) {
        let Walk { design, tables, sink, known, .. } = self;
        sink.look(&design.graph, tables, asked, |value| known[value.index()] != 0);
    }

    /// Depth first with its own stack, as for what is lowered: an entry is a value, or a choice of which the
    /// arms are left.
    fn need(&mut self, value: ValueId) {
        let mut open = vec![(value, false)];
        while let Some((value, arms_are_left)) = open.pop() {
            if !matches!(self.design.graph.kind(value), Kind::Op(..)) {
                continue;
            }
            if let Some(same) =
                same_bits(&self.design.graph, value).filter(|_| self.tables.get(value).is_none())
            {
                open.push((same, false));
                continue;
            }
            let choice = self.sink.choice(&self.design.graph, value);
            if arms_are_left {
                let arms = choice.iter().flat_map(Choice::arms);
                arms.for_each(|arm| self.aside(|walk| walk.need(arm)));
                continue;
            }
            let known = self.known[value.index()];
            if known != 0 {
                if known != self.step {
                    self.shared.push(value);
                }
                continue;
            }
            if self.tables.get(value).is_none() {
                self.known[value.index()] = self.step;
                self.undo.push((value, 0));
            }
            if choice.is_some() {
                open.push((value, true));
            }
            let before = self.sink.before(&self.design.graph, self.tables, value);
            open.extend(before.into_iter().map(|value| (value, false)));
        }
    }
}

/// The value of which it has the bits, with zeros above them or without the upper ones: it costs nothing to
/// have it again.
fn same_bits(graph: &Graph, value: ValueId) -> Option<ValueId> {
    let Kind::Op(op, operands) = graph.kind(value) else { return None };
    let is_word = |value: ValueId| (2..=64).contains(&graph.width(value));
    let is_same = match op {
        Op::ZeroExtend(_) => is_word(value),
        Op::Slice { lo: 0, .. } => is_word(value) && is_word(operands[0]),
        Op::Not => graph.width(value) == 1 && *graph.kind(operands[0]) == Kind::Stored,
        _ => false,
    };
    is_same.then(|| operands[0])
}
