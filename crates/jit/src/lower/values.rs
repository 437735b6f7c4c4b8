//! Values of the graph as values of Cranelift: a bit is an `I8` that is 0 or 1, up to 64 bits are an `I64`, more are an
//! `I128`. The bits above the width are left to chance until someone needs them to be zeros or copies of the sign.

use std::collections::HashMap;

use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::{Inst, InstBuilder, MemFlagsData, Type, Value, types};
use edgewalk_netlist::Op;
use edgewalk_netlist::ops::mask;

use super::operators;
use super::program::Plan;
use super::range::Range;
use crate::alone::Alone;
use crate::graph::{Graph, Kind, ValueId};
use crate::layout::{Layout, Place};
use crate::quiet::Wakes;
use crate::signs::Signs;
use crate::tables::{Table, Tables};

/// A value in its forms; all have the type [`lane`] of its width.
#[derive(Clone, Copy)]
pub(super) struct Lowered {
    /// Its bits; above them anything.
    pub any: Value,
    /// `any` is below 2^bits.
    pub bits: u32,
    /// Where `any` lies, read with its sign, if something is known of it.
    pub range: Option<Range>,
    /// With zeros above.
    pub zero: Option<Value>,
    /// With copies of the sign above.
    pub sign: Option<Value>,
    /// It is in its place in the state, as `any`, and has to be read there.
    is_kept: bool,
}

impl Lowered {
    /// Anything above the value's bits, but `any` is below 2^bits.
    pub fn below(any: Value, bits: u32) -> Lowered {
        Lowered { any, bits, range: Range::unsigned(bits), zero: None, sign: None, is_kept: false }
    }

    /// Anything above the value's bits, but `any` is below 2^bits, and in the range if there is one.
    pub fn within(any: Value, bits: u32, range: Option<Range>) -> Lowered {
        let bits = range.and_then(Range::bits).map_or(bits, |of_range| of_range.min(bits));
        Lowered { range: range.or(Range::unsigned(bits)), ..Lowered::below(any, bits) }
    }

    /// Copies of the sign above so many bits.
    pub fn signed(any: Value, width: u32) -> Lowered {
        let range = (width <= 64).then(|| Range::signed(width));
        Lowered { range, sign: Some(any), ..Lowered::below(any, u32::MAX) }
    }

    /// Where both are known to lie.
    pub fn ranges(self, other: Lowered) -> Option<(Range, Range)> {
        self.range.zip(other.range)
    }
}

/// The type for values of so many bits.
pub(super) fn lane(width: u32) -> Type {
    match width {
        1 => types::I8,
        2..=64 => types::I64,
        _ => types::I128,
    }
}

/// Values as far as they are computed where the cursor stands.
pub(super) struct Values<'a> {
    pub graph: &'a Graph,
    tables: &'a Tables,
    pub signs: &'a Signs,
    pub wakes: &'a Wakes,
    alone: Alone,
    pub layout: &'a Layout,
    pub cursor: FuncCursor<'a>,
    /// The address of the state.
    pub state: Value,
    /// The function and the branches within each other in which the cursor stands.
    pub(super) branches: Vec<Branch>,
    known: Vec<Option<Lowered>>,
    is_shared: Vec<bool>,
    /// What was known before, since the outermost branch began.
    undo: Vec<(ValueId, Option<Lowered>)>,
    /// Of each register of which the state may have the new value by now, where it changed.
    changed: Vec<Option<Change>>,
    /// The old values of those, read just before they change.
    old: HashMap<ValueId, Value>,
}

/// Where a register changes.
#[derive(Clone, Copy)]
struct Change {
    /// The number of the branch that knows it.
    branch: usize,
    /// The store, or what leads into the branch that has it; before it the state has the old value.
    at: Inst,
}

/// Code that is skipped as a whole, or the function.
#[derive(Default)]
pub(super) struct Branch {
    /// Registers that change in it.
    changed: Vec<ValueId>,
    /// Those of which it has read the old value.
    old: Vec<ValueId>,
    /// What is not 0 if something has changed that these units have to know.
    pub differences: Vec<(u64, Value)>,
}

impl<'a> Values<'a> {
    /// Nothing is known yet; the cursor stands in the function's first block.
    pub fn new(plan: &'a Plan, cursor: FuncCursor<'a>, state: Value) -> Values<'a> {
        let Plan { tables, signs, wakes, layout, .. } = plan;
        let graph = &plan.design.graph;
        let (known, changed) = (vec![None; graph.len()], vec![None; graph.len()]);
        let is_shared = vec![false; graph.len()];
        let (branches, undo, old) = (vec![Branch::default()], Vec::new(), HashMap::new());
        Values {
            graph,
            tables,
            signs,
            wakes,
            alone: Alone::new(graph),
            layout,
            cursor,
            state,
            branches,
            known,
            is_shared,
            undo,
            changed,
            old,
        }
    }

    /// What is computed from now on is forgotten at [`Values::leave`].
    pub fn enter(&self) -> usize {
        self.undo.len()
    }

    /// Forgets what was computed since [`Values::enter`] returned `mark`.
    pub fn leave(&mut self, mark: usize) {
        for (value, before) in self.undo.drain(mark..).rev() {
            self.known[value.index()] = before;
        }
    }

    /// These values are to be kept in the state when they are computed.
    pub fn keep(&mut self, shared: &[ValueId]) {
        shared.iter().for_each(|value| self.is_shared[value.index()] = true);
    }

    /// A step begins that asks for these values.
    pub fn look(&mut self, asked: Vec<ValueId>) {
        let Values { graph, tables, known, alone, .. } = self;
        alone.look(graph, tables, asked, |value| known[value.index()].is_some());
    }

    /// Between two steps: what they share is in the state, and registers of the processor are free.
    pub fn forget(&mut self) {
        for value in self.graph.ids() {
            if let Some(lowered) = self.known[value.index()].filter(|lowered| !lowered.is_kept) {
                let kept = self.is_shared[value.index()].then_some(Lowered { is_kept: true, ..lowered });
                self.undo.push((value, Some(lowered)));
                self.known[value.index()] = kept;
            }
        }
    }

    /// Code begins that may be skipped.
    pub fn enter_branch(&mut self) {
        self.branches.push(Branch::default());
    }

    /// The end of the branch that was entered last: of what changed in it nothing has changed on other ways. Returns that.
    pub fn leave_branch(&mut self) -> Vec<ValueId> {
        let Branch { changed, old, .. } = self.branches.pop().unwrap_or_default();
        for register in old {
            self.old.remove(&register);
        }
        for register in &changed {
            self.changed[register.index()] = None;
        }
        changed
    }

    /// The value has to be worked out in this step, not looked up or read again.
    pub fn is_worked_out(&self, value: ValueId) -> bool {
        self.known[value.index()].is_none()
            && self.tables.get(value).is_none()
            && !self.is_shared[value.index()]
    }

    /// The value with zeros above its bits.
    pub fn zero(&mut self, value: ValueId) -> Value {
        let lowered = self.demand(value);
        if let Some(zero) = lowered.zero {
            return zero;
        }
        let width = self.graph.width(value);
        let zero = if lowered.bits <= width { lowered.any } else { self.masked(lowered.any, width) };
        self.set(value, Lowered { zero: Some(zero), ..lowered });
        zero
    }

    /// The value with copies of its sign above its bits.
    pub fn sign(&mut self, value: ValueId) -> Value {
        let lowered = self.demand(value);
        if let Some(sign) = lowered.sign {
            return sign;
        }
        let width = self.graph.width(value);
        let sign = match lowered.range {
            Some(range) if range.is_signed(width.min(64)) => lowered.any,
            _ => operators::sign_extended(self, lowered.any, width),
        };
        self.set(value, Lowered { sign: Some(sign), ..lowered });
        sign
    }

    /// The value is there for the steps that follow, if they share it.
    pub fn work_out(&mut self, value: ValueId) {
        self.demand(value);
    }

    /// The value with anything above its bits.
    pub fn any(&mut self, value: ValueId) -> Lowered {
        self.demand(value)
    }

    /// The low `width` bits, zeros above.
    pub fn masked(&mut self, value: Value, width: u32) -> Value {
        let ty = self.cursor.func.dfg.value_type(value);
        if width >= ty.bits() {
            return value;
        }
        if ty == types::I128 {
            let (low, high) = self.cursor.ins().isplit(value);
            let high = self.masked(high, width - 64);
            return self.cursor.ins().iconcat(low, high);
        }
        let ones = self.constant(ty, mask(width));
        self.cursor.ins().band(value, ones)
    }

    /// A constant of this type.
    pub fn constant(&mut self, ty: Type, value: u128) -> Value {
        if ty == types::I128 {
            let low = self.cursor.ins().iconst(types::I64, value as u64 as i64);
            let high = self.cursor.ins().iconst(types::I64, (value >> 64) as u64 as i64);
            return self.cursor.ins().iconcat(low, high);
        }
        self.cursor.ins().iconst(ty, value as u64 as i64)
    }

    /// Stores a value, with zeros above its bits, in a place of its width.
    pub fn store(&mut self, value: ValueId, place: Place) {
        let zero = self.zero(value);
        let state = self.state;
        self.cursor.ins().store(flags(place.width), zero, state, place.offset);
    }

    /// Stores the next value of a register.
    pub fn store_register(&mut self, register: ValueId, value: Value) {
        if let Some(place) = self.layout.of(register) {
            let state = self.state;
            let store = self.cursor.ins().store(flags(place.width), value, state, place.offset);
            self.change(register, store);
        }
    }

    /// The value as the register keeps it.
    pub fn as_kept(&mut self, register: ValueId, value: ValueId) -> Value {
        if self.signs.has(register) { self.sign(value) } else { self.zero(value) }
    }

    /// Stores what a register is after a reset, when nobody reads it any more.
    pub fn store_reset(&mut self, register: ValueId, value: u128) {
        if let Some(place) = self.layout.of(register) {
            let sign = 1 << (place.width - 1);
            let value = if self.signs.has(register) { (value ^ sign).wrapping_sub(sign) } else { value };
            let (state, value) = (self.state, self.constant(lane(place.width), value));
            self.cursor.ins().store(flags(place.width), value, state, place.offset);
        }
    }

    /// The state may have the new value of this register from `at` on.
    pub fn change(&mut self, register: ValueId, at: Inst) {
        let branch = self.branches.len() - 1;
        self.changed[register.index()] = Some(Change { branch, at });
        self.branches[branch].changed.push(register);
    }

    fn set(&mut self, value: ValueId, lowered: Lowered) {
        let before = self.known[value.index()].replace(lowered);
        self.undo.push((value, before));
    }

    /// Computes the value and all it needs. Depth first with its own stack: a chain of operators can be long.
    fn demand(&mut self, value: ValueId) -> Lowered {
        let mut stack = vec![value];
        loop {
            // The stack has an entry until the value that was asked for is known.
            let value = stack[stack.len() - 1];
            if let Some(mut lowered) = self.known[value.index()] {
                if lowered.is_kept {
                    lowered = self.read_again(value, lowered);
                    self.set(value, lowered);
                }
                stack.pop();
                if stack.is_empty() {
                    return lowered;
                }
                continue;
            }
            let waiting = stack.len();
            let before = self.alone.before(self.graph, self.tables, value);
            stack.extend(before.into_iter().rev().filter(|operand| self.known[operand.index()].is_none()));
            if stack.len() == waiting {
                let lowered = self.compute(value);
                self.set(value, lowered);
                if self.is_shared[value.index()] {
                    self.store_shared(value, lowered.any);
                }
            }
        }
    }

    fn store_shared(&mut self, value: ValueId, any: Value) {
        if let Some(place) = self.layout.of(value) {
            let state = self.state;
            self.cursor.ins().store(flags(place.width), any, state, place.offset);
        }
    }

    /// A value that is kept.
    fn read_again(&mut self, value: ValueId, lowered: Lowered) -> Lowered {
        let any = match self.layout.of(value) {
            Some(Place { offset, width }) => {
                self.cursor.ins().load(lane(width), flags(width), self.state, offset)
            }
            None => self.constant(lane(self.graph.width(value)), 0), // never: it has a place
        };
        Lowered { any, zero: None, sign: None, is_kept: false, ..lowered }
    }

    /// A choice whose arms are computed only where they are taken.
    fn chosen(&mut self, condition: ValueId, arms: [ValueId; 2], width: u32) -> Lowered {
        let condition = self.zero(condition);
        let blocks = arms.map(|_| self.cursor.func.dfg.make_block());
        let next = self.cursor.func.dfg.make_block();
        let either = self.cursor.func.dfg.append_block_param(next, lane(width));
        self.cursor.ins().brif(condition, blocks[0], &[], blocks[1], &[]);
        let mut of_arms = Vec::new();
        for (arm, block) in arms.into_iter().zip(blocks) {
            let mark = self.enter();
            self.cursor.insert_block(block);
            let lowered = self.any(arm);
            of_arms.push(lowered);
            self.cursor.ins().jump(next, &[lowered.any.into()]);
            self.leave(mark);
        }
        self.cursor.insert_block(next);
        operators::either(either, of_arms[0], of_arms[1])
    }

    fn compute(&mut self, value: ValueId) -> Lowered {
        let width = self.graph.width(value);
        if let Some(table) = self.tables.get(value) {
            return self.looked_up(table, width);
        }
        match self.graph.kind(value) {
            Kind::Op(Op::Mux, operands) if self.alone.branches(value) => {
                self.chosen(operands[0], [operands[1], operands[2]], width)
            }
            Kind::Stored if self.signs.has(value) => Lowered::signed(self.stored(value, width), width),
            Kind::Stored => Lowered::below(self.stored(value, width), width),
            Kind::Constant(constant) => {
                Lowered::below(self.constant(lane(width), *constant), 128 - constant.leading_zeros())
            }
            Kind::Op(op, operands) => {
                let lowered = operators::lower(self, *op, width, operands);
                if width == 1 && lowered.bits > 1 {
                    return Lowered::below(self.masked(lowered.any, 1), 1);
                }
                lowered
            }
        }
    }

    /// An entry of a table.
    fn looked_up(&mut self, table: Table, width: u32) -> Lowered {
        let index = self.zero(table.index);
        let (flags, state, offset) =
            (MemFlagsData::trusted(), self.state, self.layout.tables + table.first as i32);
        let address = self.cursor.ins().iadd(state, index);
        let ins = self.cursor.ins();
        let entry = match width {
            1 => ins.load(types::I8, flags, address, offset),
            _ => ins.uload8(types::I64, flags, address, offset),
        };
        Lowered::below(entry, width)
    }

    /// An input or the old value of a register.
    fn stored(&mut self, value: ValueId, width: u32) -> Value {
        let Some(Place { offset, .. }) = self.layout.of(value) else {
            return self.constant(lane(width), 0); // never: the layout has all that is stored
        };
        let state = self.state;
        let Some(Change { branch, at }) = self.changed[value.index()] else {
            return self.cursor.ins().load(lane(width), flags(width), state, offset);
        };
        if let Some(old) = self.old.get(&value) {
            return *old;
        }
        let here = self.cursor.position();
        self.cursor.goto_inst(at);
        let old = self.cursor.ins().load(lane(width), flags(width), state, offset);
        self.cursor.set_position(here);
        self.old.insert(value, old);
        self.branches[branch].old.push(value);
        old
    }
}

/// No access traps: all places lie within the state. They are aligned to 8 bytes.
pub(super) fn flags(width: u32) -> MemFlagsData {
    if width <= 64 { MemFlagsData::trusted() } else { MemFlagsData::new().with_notrap() }
}
