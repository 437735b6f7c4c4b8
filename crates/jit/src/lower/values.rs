//! Values of the graph as values of Cranelift: a bit is an `I8` that is 0 or 1, up to 64 bits are an `I64`, more are an
//! `I128`. The bits above the width are left to chance until someone needs them to be zeros or copies of the sign.

use std::collections::HashMap;

use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::{Block, InstBuilder, MemFlagsData, Type, Value, types};
use edgewalk_netlist::Op;
use edgewalk_netlist::ops::mask;

use super::alone::Alone;
use super::operators;
use crate::graph::{Graph, Kind, ValueId};
use crate::layout::{Layout, Place};

/// A value in its forms; all have the type [`lane`] of its width.
#[derive(Clone, Copy)]
pub(super) struct Lowered {
    /// Its bits; above them anything.
    pub any: Value,
    /// `any` is below 2^bits.
    pub bits: u32,
    /// With zeros above.
    pub zero: Option<Value>,
    /// With copies of the sign above.
    pub sign: Option<Value>,
}

impl Lowered {
    /// Anything above the value's bits, but `any` is below 2^bits.
    pub fn below(any: Value, bits: u32) -> Lowered {
        Lowered { any, bits, zero: None, sign: None }
    }

    /// Copies of the sign above the value's bits.
    pub fn signed(any: Value) -> Lowered {
        Lowered { any, bits: u32::MAX, zero: None, sign: Some(any) }
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
    alone: &'a Alone,
    pub layout: &'a Layout,
    pub cursor: FuncCursor<'a>,
    /// The address of the state.
    pub state: Value,
    /// The function and the branches within each other in which the cursor stands.
    branches: Vec<Branch>,
    known: Vec<Option<Lowered>>,
    /// What was known before, since the outermost branch began.
    undo: Vec<(ValueId, Option<Lowered>)>,
    /// Of each register of which the state may have the new value by now, the number of the branch that knows it.
    changed: Vec<Option<usize>>,
    /// The old values of those, read where their branch begins.
    old: HashMap<ValueId, Value>,
}

/// Code that is skipped as a whole, or the function.
struct Branch {
    /// Where it begins: before any change in it.
    head: Block,
    /// Registers that change in it.
    changed: Vec<ValueId>,
    /// Those of which it has read the old value.
    old: Vec<ValueId>,
}

impl Branch {
    fn at(head: Block) -> Branch {
        Branch { head, changed: Vec::new(), old: Vec::new() }
    }
}

impl<'a> Values<'a> {
    /// Nothing is known yet; the cursor stands in the function's first block, `head`.
    pub fn new(
        graph: &'a Graph,
        alone: &'a Alone,
        layout: &'a Layout,
        cursor: FuncCursor<'a>,
        state: Value,
        head: Block,
    ) -> Values<'a> {
        let (known, changed) = (vec![None; graph.len()], vec![None; graph.len()]);
        let (branches, undo, old) = (vec![Branch::at(head)], Vec::new(), HashMap::new());
        Values { graph, alone, layout, cursor, state, branches, known, undo, changed, old }
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

    /// A branch that begins with this block.
    pub fn enter_branch(&mut self, head: Block) {
        self.branches.push(Branch::at(head));
    }

    /// The end of the branch that was entered last; what changed in it has changed in the one around it.
    pub fn leave_branch(&mut self) {
        let Some(Branch { changed, old, .. }) = self.branches.pop() else { return };
        for register in old {
            self.old.remove(&register);
        }
        for register in changed {
            self.change(register);
        }
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
        let sign = operators::sign_extended(self, lowered.any, width);
        self.set(value, Lowered { sign: Some(sign), ..lowered });
        sign
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

    /// Stores the next value of a register; [`Values::change`] is to follow.
    pub fn store_register(&mut self, register: ValueId, value: Value) {
        if let Some(place) = self.layout.of(register) {
            let state = self.state;
            self.cursor.ins().store(flags(place.width), value, state, place.offset);
        }
    }

    /// The state may have the new value of this register from here on.
    pub fn change(&mut self, register: ValueId) {
        self.changed[register.index()] = self.branches.len().checked_sub(1);
        if let Some(branch) = self.branches.last_mut() {
            branch.changed.push(register);
        }
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
            if let Some(lowered) = self.known[value.index()] {
                stack.pop();
                if stack.is_empty() {
                    return lowered;
                }
                continue;
            }
            let waiting = stack.len();
            stack.extend(self.needed_first(value).filter(|operand| self.known[operand.index()].is_none()));
            if stack.len() == waiting {
                let lowered = self.compute(value);
                self.set(value, lowered);
            }
        }
    }

    /// What has to be there before the value is computed, the last first: its operands, but of an arm that is computed where it
    /// is taken only what it shares with others.
    fn needed_first(&self, value: ValueId) -> impl Iterator<Item = ValueId> {
        let operands = self.graph.operands(value);
        let mut needed = operands.to_vec();
        if self.alone.branches(value) {
            needed.truncate(1);
            operands[1..].iter().for_each(|arm| self.alone.shared(self.graph, *arm, &mut needed));
        }
        needed.into_iter().rev()
    }

    /// A choice whose arms are computed only where they are taken.
    fn chosen(&mut self, condition: ValueId, arms: [ValueId; 2], width: u32) -> Lowered {
        let condition = self.zero(condition);
        let blocks = arms.map(|_| self.cursor.func.dfg.make_block());
        let next = self.cursor.func.dfg.make_block();
        let either = self.cursor.func.dfg.append_block_param(next, lane(width));
        self.cursor.ins().brif(condition, blocks[0], &[], blocks[1], &[]);
        let mut bits = 0;
        for (arm, block) in arms.into_iter().zip(blocks) {
            let mark = self.enter();
            self.cursor.insert_block(block);
            let lowered = self.any(arm);
            bits = bits.max(lowered.bits);
            self.cursor.ins().jump(next, &[lowered.any.into()]);
            self.leave(mark);
        }
        self.cursor.insert_block(next);
        Lowered::below(either, bits)
    }

    fn compute(&mut self, value: ValueId) -> Lowered {
        let width = self.graph.width(value);
        match self.graph.kind(value) {
            Kind::Op(Op::Mux, operands) if self.alone.branches(value) => {
                self.chosen(operands[0], [operands[1], operands[2]], width)
            }
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

    /// An input or the old value of a register.
    fn stored(&mut self, value: ValueId, width: u32) -> Value {
        let Some(Place { offset, .. }) = self.layout.of(value) else {
            return self.constant(lane(width), 0); // never: the layout has all that is stored
        };
        let state = self.state;
        let Some(branch) = self.changed[value.index()] else {
            return self.cursor.ins().load(lane(width), flags(width), state, offset);
        };
        if let Some(old) = self.old.get(&value) {
            return *old;
        }
        let here = self.cursor.position();
        self.cursor.goto_first_insertion_point(self.branches[branch].head);
        let old = self.cursor.ins().load(lane(width), flags(width), state, offset);
        self.cursor.set_position(here);
        self.old.insert(value, old);
        self.branches[branch].old.push(value);
        old
    }
}

/// No access traps: all places lie within the state. They are aligned to 8 bytes.
fn flags(width: u32) -> MemFlagsData {
    if width <= 64 { MemFlagsData::trusted() } else { MemFlagsData::new().with_notrap() }
}
