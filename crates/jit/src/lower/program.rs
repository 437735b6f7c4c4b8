//! The programs: which values are computed in which order, and where branches go.

use std::collections::BTreeMap;

use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::{Block, Function, Inst, InstBuilder, Type};
use edgewalk_netlist::Op;

use super::plan::{Plan, Program};
use super::values::Values;
use crate::design::Design;
use crate::graph::ValueId;
use crate::groups::{Group, Member};
use crate::layout::Place;
use crate::step::Step;
use crate::wakes::MOST;

/// Members that choose by the same bit share a branch if they are so many or more.
const LEAST_CHOOSING: usize = 3;

/// Fills the function, which has its signature already.
pub(crate) fn lower(
    program: Program,
    plan: &Plan,
    pointer: Type,
    has_vectors: bool,
    function: &mut Function,
) {
    let Plan { design, steps, .. } = plan;
    let head = function.dfg.make_block();
    let address = function.dfg.append_block_param(head, pointer);
    let mut cursor = FuncCursor::new(function);
    cursor.insert_block(head);
    let mut lowering = Lowering { design, v: Values::new(plan, cursor, address, has_vectors), idle: true };
    match program {
        Program::Clock => {
            lowering.v.known.keep(&plan.shared);
            lowering.sample();
            lowering.clock(steps);
        }
        Program::Outputs => lowering.compute(design.outputs.iter().map(|(_, value)| *value)),
        Program::Signals => lowering.compute(design.signals.values().copied()),
    }
    lowering.v.cursor.ins().return_(&[]);
}

/// A program being written.
pub(super) struct Lowering<'a> {
    pub design: &'a Design,
    pub v: Values<'a>,
    /// Whether the conditions around hold while nothing is to be done.
    idle: bool,
}

impl Lowering<'_> {
    fn compute(&mut self, values: impl Iterator<Item = ValueId> + Clone) {
        self.v.look(values.clone().collect());
        let graph = self.v.graph();
        for value in values.filter(|value| graph.is_computed(*value)) {
            if let Some(place) = self.v.plan.layout.of(value) {
                self.v.store(value, place);
            }
        }
    }

    fn sample(&mut self) {
        self.v.look(self.design.outputs.iter().map(|(_, value)| *value).collect());
        let outputs: Vec<(ValueId, Place)> = self
            .design
            .outputs
            .iter()
            .map(|(_, value)| *value)
            .zip(self.v.plan.layout.sampled.iter().copied())
            .collect();
        let mut left = &outputs[..];
        while let [(value, place), others @ ..] = left {
            left = others;
            if let [(next, next_place), others @ ..] = left
                && let Some(first) = self.output_copied(*value, *place)
                && let Some(second) = self.output_copied(*next, *next_place)
                && self.copy_both([first, second], &[])
            {
                left = others;
            } else {
                self.v.store(*value, *place);
            }
        }
    }

    /// The steps; then what is reset, whatever it became in them.
    fn clock(&mut self, steps: &[Step]) {
        self.steps(steps);
        self.v.wake_changed();
        let resets = self.design.registers.iter().filter_map(|register| Some((register.q, register.reset?)));
        let resets: Vec<(ValueId, u128)> = resets.collect();
        if !resets.is_empty() {
            self.only_if(self.design.reset, |lowering| {
                for (q, value) in resets {
                    lowering.v.store_reset(q, value);
                }
                lowering.v.wake(u64::MAX);
            });
        }
    }

    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            self.v.known.forget(self.v.graph());
            self.v.look(step.asked(self.design));
            match step {
                Step::Change(group) => self.change(group, group.conditions.len()),
                Step::Write(memory) => {
                    let area = self.v.plan.layout.memories[*memory];
                    let wakes = 1 << self.design.memories[*memory].unit.min(MOST - 1);
                    self.design.memories[*memory]
                        .writes
                        .iter()
                        .for_each(|port| self.write(*port, area, wakes));
                }
                Step::Early(bits) => bits.iter().for_each(|bit| self.v.work_out(*bit)),
                Step::Unit { unit, then, .. } if self.v.plan.wakes.rests(*unit) => self.unit(*unit, then),
                Step::Unit { then, .. } => self.steps(then),
                Step::If { bit, then } => {
                    let idle = self.idle && self.v.plan.wakes.is_idle(*bit);
                    let around = std::mem::replace(&mut self.idle, idle);
                    self.only_if(*bit, |lowering| lowering.steps(then));
                    self.idle = around;
                }
            }
        }
    }

    /// The steps of a unit, which are left out when its counter is 0.
    fn unit(&mut self, unit: usize, then: &[Step]) {
        let clocks = self.v.clocks_now(unit);
        let [block, next] = [(); 2].map(|()| self.v.cursor.func.dfg.make_block());
        let way = self.v.cursor.ins().brif(clocks, block, &[], next, &[]);
        let changed = self.inside(block, next, |lowering| {
            let clocks = lowering.v.asked(unit, clocks);
            lowering.v.count(unit, clocks);
            lowering.steps(then);
        });
        self.v.cursor.insert_block(next);
        changed.into_iter().for_each(|register| self.v.changes.change(register, way));
    }

    /// The strongest condition is asked first, of those below `rank`.
    fn change(&mut self, group: &Group, rank: usize) {
        let Some(rank) = rank.checked_sub(1) else { return };
        let condition = group.conditions[rank];
        if self.v.graph().as_constant(condition) == Some(1) {
            return self.take(group, rank);
        }
        self.either(
            condition,
            |lowering| lowering.take(group, rank),
            |lowering| lowering.change(group, rank),
        );
    }

    /// All members take their value of this rank, in an order in which most are read before they change.
    /// Where that is while nothing is to be done, other units have them compared with what they were; else
    /// they count as changed.
    fn take(&mut self, group: &Group, rank: usize) {
        if let Some(bit) = self.common_choice(group, rank) {
            let chooses = |member: &&Member| self.choice(member, rank) == Some(bit);
            let (choosing, others) = group.members.iter().cloned().partition(|member| chooses(&member));
            let with = |members: Vec<Member>| Group { members, ..group.clone() };
            let (choosing, others) = (with(choosing), with(others));
            let [one, zero] = [1, 2].map(|arm| self.with_arms(&choosing, rank, arm));
            self.either(bit, |lowering| lowering.take(&one, rank), |lowering| lowering.take(&zero, rank));
            return self.take(&others, rank);
        }
        let is_compared = self.is_compared(group, rank);
        let mut changed = 0;
        let mut left = &group.members[..];
        while let [member, others @ ..] = left {
            left = others;
            if member.stays(rank) {
                continue;
            }
            if let [next, others @ ..] = left
                && let Some(first) = self.member_copied(group, member, rank)
                && let Some(second) = self.member_copied(group, next, rank)
                && let both = [member, next].map(|member| member.q(self.design))
                && self.copy_both([first, second], &both)
            {
                if !is_compared {
                    changed |= both.iter().fold(0, |units, q| units | self.v.plan.wakes.of(*q));
                }
                left = others;
                continue;
            }
            let (q, value) = match member {
                Member::Register { q, values } => (*q, self.v.taken(*q, values[rank])),
                Member::Read { memory, port } => self.read(*memory, *port),
            };
            let wakes = self.v.plan.wakes.of(q);
            if is_compared {
                self.v.compare(q, value, wakes & !self.v.plan.wakes.own(group.unit));
            } else {
                changed |= wakes;
            }
            self.v.store_register(q, value);
        }
        self.v.wake(changed);
    }

    /// Whether other units have what changes at this rank compared with what it was.
    pub fn is_compared(&self, group: &Group, rank: usize) -> bool {
        self.idle && self.v.plan.wakes.is_idle(group.conditions[rank])
    }

    /// The bit by which most members choose, if they are several.
    fn common_choice(&self, group: &Group, rank: usize) -> Option<ValueId> {
        let mut bits: BTreeMap<ValueId, usize> = BTreeMap::new();
        for bit in group.members.iter().filter_map(|member| self.choice(member, rank)) {
            *bits.entry(bit).or_default() += 1;
        }
        let (bit, members) = bits.into_iter().max_by_key(|(_, members)| *members)?;
        (members >= LEAST_CHOOSING).then_some(bit)
    }

    /// The bit by which a member chooses what it takes.
    fn choice(&self, member: &Member, rank: usize) -> Option<ValueId> {
        match member {
            Member::Register { values, .. } if self.v.is_worked_out(values[rank]) => {
                Some(self.v.graph().as_op(values[rank], Op::Mux)?[0])
            }
            _ => None,
        }
    }

    /// The group with what its members take if they choose this operand of their choices.
    fn with_arms(&self, group: &Group, rank: usize, operand: usize) -> Group {
        let mut group = group.clone();
        for member in &mut group.members {
            if let Member::Register { values, .. } = member
                && let Some(operands) = self.v.graph().as_op(values[rank], Op::Mux)
            {
                values[rank] = operands[operand];
            }
        }
        group
    }

    /// What is filled in happens if the bit is 1; what is computed in it stays in it.
    pub fn only_if(&mut self, bit: ValueId, fill: impl FnOnce(&mut Self)) {
        self.either(bit, fill, |_| {});
    }

    /// The one happens if the bit is 1, the other if it is 0; what is computed in them stays in them.
    fn either(&mut self, bit: ValueId, one: impl FnOnce(&mut Self), zero: impl FnOnce(&mut Self)) {
        let [yes, no, next] = [(); 3].map(|()| self.v.cursor.func.dfg.make_block());
        let way = self.branch(bit, yes, no);
        let mut changed = self.inside(yes, next, one);
        changed.extend(self.inside(no, next, zero));
        self.v.cursor.insert_block(next);
        changed.into_iter().for_each(|register| self.v.changes.change(register, way));
    }

    /// Where the bit decides; its opposite need not be computed.
    fn branch(&mut self, bit: ValueId, yes: Block, no: Block) -> Inst {
        match self.v.graph().as_op(bit, Op::Not) {
            Some(&[opposite]) => {
                let condition = self.v.condition(opposite);
                self.v.cursor.ins().brif(condition, no, &[], yes, &[])
            }
            _ => {
                let condition = self.v.condition(bit);
                self.v.cursor.ins().brif(condition, yes, &[], no, &[])
            }
        }
    }

    /// A block from which the way leads on to `next`; returns the registers that change in it.
    fn inside(&mut self, block: Block, next: Block, fill: impl FnOnce(&mut Self)) -> Vec<ValueId> {
        let mark = self.v.known.enter();
        self.v.cursor.insert_block(block);
        self.v.changes.enter_branch();
        fill(self);
        self.v.wake_changed();
        self.v.cursor.ins().jump(next, &[]);
        self.v.known.leave(mark);
        self.v.changes.leave_branch()
    }
}
