//! The functions: what is computed in which order, and where branches go.

use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::{Block, Function, InstBuilder, Type, Value};
use edgewalk_netlist::Op;

use super::alone::Alone;
use super::values::{Values, lane};
use crate::design::Design;
use crate::graph::{Graph, Kind, ValueId};
use crate::groups::{Group, Member};
use crate::layout::Layout;
use crate::step::Step;

/// A function of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Program {
    /// Samples the outputs, then a clock.
    Clock,
    /// The outputs of this cycle.
    Outputs,
    /// All signals with a name.
    Signals,
}

/// Fills the function, which has its signature already.
pub(crate) fn lower(
    program: Program,
    design: &Design,
    steps: &[Step],
    layout: &Layout,
    pointer: Type,
    function: &mut Function,
) {
    let head = function.dfg.make_block();
    let state = function.dfg.append_block_param(head, pointer);
    let mut cursor = FuncCursor::new(function);
    cursor.insert_block(head);
    let alone = Alone::of(design, steps);
    let mut lowering =
        Lowering { design, v: Values::new(&design.graph, &alone, layout, cursor, state, head) };
    match program {
        Program::Clock => {
            lowering.sample();
            lowering.clock(steps);
        }
        Program::Outputs => lowering.compute(design.outputs.iter().map(|(_, value)| *value)),
        Program::Signals => lowering.compute(design.signals.values().copied()),
    }
    lowering.v.cursor.ins().return_(&[]);
}

/// Whether a value must be computed to be read; else it is in the state all the time.
pub(crate) fn is_computed(graph: &Graph, value: ValueId) -> bool {
    matches!(graph.kind(value), Kind::Op(..))
}

/// A program being written.
pub(super) struct Lowering<'a> {
    pub design: &'a Design,
    pub v: Values<'a>,
}

impl Lowering<'_> {
    fn compute(&mut self, values: impl Iterator<Item = ValueId>) {
        for value in values.filter(|value| is_computed(self.v.graph, *value)) {
            if let Some(place) = self.v.layout.of(value) {
                self.v.store(value, place);
            }
        }
    }

    fn sample(&mut self) {
        for ((_, value), place) in self.design.outputs.iter().zip(&self.v.layout.sampled) {
            self.v.store(*value, *place);
        }
    }

    /// Registers and read ports, then the words of the memories, as the reads see those from before the writes.
    fn clock(&mut self, steps: &[Step]) {
        self.steps(steps);
        for (memory, area) in self.design.memories.iter().zip(&self.v.layout.memories) {
            for port in &memory.writes {
                self.write(*port, *area);
            }
        }
        let resets = self.design.registers.iter().filter_map(|register| Some((register.q, register.reset?)));
        let resets: Vec<(ValueId, u128)> = resets.collect();
        if !resets.is_empty() {
            self.only_if(self.design.reset, |lowering| {
                for (q, value) in resets {
                    let value = lowering.v.constant(lane(lowering.v.graph.width(q)), value);
                    lowering.v.store_register(q, value);
                }
            });
        }
    }

    /// The conditions come before the branches, so that all steps share what they have in common.
    fn steps(&mut self, steps: &[Step]) {
        for condition in steps.iter().flat_map(Step::conditions) {
            self.v.zero(*condition);
        }
        for step in steps {
            match step {
                Step::Change(group) => self.change(group),
                Step::If { bit, then } => self.only_if(*bit, |lowering| lowering.steps(then)),
            }
        }
    }

    /// The strongest condition is asked first.
    fn change(&mut self, group: &Group) {
        let next = self.v.cursor.func.dfg.make_block();
        let mark = self.v.enter();
        for (rank, condition) in group.conditions.iter().enumerate().rev() {
            if self.v.graph.as_constant(*condition) == Some(1) {
                self.take(group, rank);
                break;
            }
            let [yes, no] = [(); 2].map(|()| self.v.cursor.func.dfg.make_block());
            self.branch(*condition, yes, no);
            self.v.cursor.insert_block(yes);
            let inner = self.v.enter();
            self.take(group, rank);
            self.v.cursor.ins().jump(next, &[]);
            self.v.leave(inner);
            self.v.cursor.insert_block(no);
        }
        self.v.cursor.ins().jump(next, &[]);
        self.v.leave(mark);
        self.v.cursor.insert_block(next);
        for member in &group.members {
            self.v.change(match member {
                Member::Register { q, .. } => *q,
                Member::Read { memory, port } => self.design.memories[*memory].reads[*port].q,
            });
        }
    }

    /// All members take their value of this rank. They change together: all values are there before one is stored.
    fn take(&mut self, group: &Group, rank: usize) {
        let value = |lowering: &mut Self, member: &Member| match member {
            Member::Register { q, values } => (*q, lowering.v.zero(values[rank])),
            Member::Read { memory, port } => lowering.read(*memory, *port),
        };
        let values: Vec<(ValueId, Value)> = group.members.iter().map(|member| value(self, member)).collect();
        for (q, value) in values {
            self.v.store_register(q, value);
        }
    }

    /// Where the bit decides; its opposite need not be computed.
    fn branch(&mut self, bit: ValueId, yes: Block, no: Block) {
        match self.v.graph.as_op(bit, Op::Not) {
            Some(&[opposite]) => {
                let condition = self.v.zero(opposite);
                self.v.cursor.ins().brif(condition, no, &[], yes, &[]);
            }
            _ => {
                let condition = self.v.zero(bit);
                self.v.cursor.ins().brif(condition, yes, &[], no, &[]);
            }
        }
    }

    /// What is filled in happens if the bit is 1; what is computed in it stays in it.
    pub fn only_if(&mut self, bit: ValueId, fill: impl FnOnce(&mut Self)) {
        let [block, next] = [(); 2].map(|()| self.v.cursor.func.dfg.make_block());
        self.branch(bit, block, next);
        self.inside(block, next, fill);
    }

    /// A block from which the way leads on to `next`.
    fn inside(&mut self, block: Block, next: Block, fill: impl FnOnce(&mut Self)) {
        let mark = self.v.enter();
        self.v.cursor.insert_block(block);
        self.v.enter_branch(block);
        fill(self);
        self.v.cursor.ins().jump(next, &[]);
        self.v.leave_branch();
        self.v.leave(mark);
        self.v.cursor.insert_block(next);
    }
}
