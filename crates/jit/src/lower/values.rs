//! Values as far as they are computed: each when it is asked for, with all it needs, and known from then on where the cursor stands.

use std::collections::HashMap;

use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Type, Value, types};
use edgewalk_netlist::Op;
use edgewalk_netlist::ops::mask;

use super::lowered::{Lowered, lane};
use super::operators;
use super::program::Plan;
use super::registers::{Branch, Change};
use crate::alone::{Alone, Choice};
use crate::graph::{Graph, Kind, ValueId};
use crate::layout::{Layout, Place};
use crate::quiet::Wakes;
use crate::signs::Signs;
use crate::tables::{Table, Tables};

/// A program takes the state's address and so many bytes more, so that the lowest bit of what it is given is 1: see
/// [`Values::condition`]. Where the host has no instruction that tests memory, none.
pub(crate) const ODD: i64 = if cfg!(target_arch = "x86_64") { 1 } else { 0 };

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
    /// The low 32 bits of that and [`ODD`].
    odd: Value,
    /// Whether the host has words of 128 bits.
    pub has_vectors: bool,
    /// The function and the branches within each other in which the cursor stands.
    pub(super) branches: Vec<Branch>,
    known: Vec<Option<Lowered>>,
    is_shared: Vec<bool>,
    /// What a register takes next: it is kept there, if it is kept.
    taken: Option<ValueId>,
    /// The registers that have taken values which are kept.
    takers: HashMap<ValueId, ValueId>,
    /// What was known before, since the outermost branch began.
    undo: Vec<(ValueId, Option<Lowered>)>,
    /// Of each register of which the state may have the new value by now, where it changed.
    pub(super) changed: Vec<Option<Change>>,
    /// The old values of those, read just before they change.
    pub(super) old: HashMap<ValueId, Value>,
}

impl<'a> Values<'a> {
    /// Nothing is known yet; the cursor stands in the function's first block.
    pub fn new(plan: &'a Plan, mut cursor: FuncCursor<'a>, address: Value, has_vectors: bool) -> Values<'a> {
        let Plan { tables, signs, wakes, layout, .. } = plan;
        let graph = &plan.design.graph;
        let (known, changed) = (vec![None; graph.len()], vec![None; graph.len()]);
        let is_shared = vec![false; graph.len()];
        // Cranelift takes it into each access.
        let state = cursor.ins().iadd_imm_s(address, -ODD);
        let odd = cursor.ins().ireduce(types::I32, address);
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
            odd,
            has_vectors,
            branches,
            known,
            is_shared,
            taken: None,
            takers: HashMap::new(),
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

    /// The value with zeros above its bits, a bit too as a word.
    pub fn word(&mut self, value: ValueId) -> Value {
        if self.graph.width(value) > 1 {
            return self.zero(value);
        }
        match self.demand(value) {
            Lowered { word: Some(word), bits: 0..=1, .. } => word,
            Lowered { word: Some(word), .. } => self.masked(word, 1),
            _ => {
                let zero = self.zero(value);
                self.cursor.ins().uextend(types::I64, zero)
            }
        }
    }

    /// A bit as a word with anything above, if it is known as one.
    pub fn known_word(&self, bit: ValueId) -> Option<Value> {
        self.known[bit.index()].filter(|bit| !bit.is_kept)?.word
    }

    /// Neither looked up nor kept.
    pub fn is_worked_out_here(&self, value: ValueId) -> bool {
        self.tables.get(value).is_none() && !self.is_shared[value.index()]
    }

    /// A bit that decides something: not 0 if it is 1. One that lies in the state is tested there, each time anew. With the odd address,
    /// as the place has nothing but zeros above the bit: `test [place], address` is one instruction of the host and takes no register; with
    /// a constant instead Cranelift would load the bit first.
    pub fn condition(&mut self, bit: ValueId) -> Value {
        let Some(Place { offset, .. }) = self.tested_in_place(bit) else { return self.zero(bit) };
        // Cranelift tests 32 bits of memory or more.
        let place = self.cursor.ins().load(types::I32, flags(1), self.state, offset);
        self.cursor.ins().band(self.odd, place)
    }

    /// Where a bit lies in the state, if it is not in a register of the host already.
    fn tested_in_place(&self, bit: ValueId) -> Option<Place> {
        let lies = self.known[bit.index()].is_none_or(|known| known.is_kept)
            && matches!(self.graph.kind(bit), Kind::Stored)
            && self.changed[bit.index()].is_none();
        self.layout.of(bit).filter(|place| lies && place.width == 1 && ODD == 1)
    }

    /// A bit that is there as a word below 2^bits.
    pub fn bit(&mut self, word: Value, bits: u32) -> Lowered {
        Lowered::bit(self.cursor.ins().ireduce(types::I8, word), word, bits)
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
            let decides = self.graph.as_op(value, Op::Mux).and_then(|operands| operands.first().copied());
            let waits = |operand: &ValueId| {
                let is_tested = decides == Some(*operand) && self.tested_in_place(*operand).is_some();
                self.known[operand.index()].is_none() && !is_tested
            };
            stack.extend(before.into_iter().rev().filter(waits));
            if stack.len() == waiting {
                let lowered = self.compute(value);
                self.set(value, lowered);
                if self.is_shared[value.index()] && self.taken != Some(value) {
                    self.takers.remove(&value);
                    self.store_shared(value, lowered.any);
                }
            }
        }
    }

    /// What is in a place; a bit as a word.
    pub fn load(&mut self, Place { offset, width }: Place) -> Value {
        let state = self.state;
        match width {
            1 => self.cursor.ins().uload8(types::I64, flags(1), state, offset),
            _ => self.cursor.ins().load(lane(width), flags(width), state, offset),
        }
    }

    /// What a register takes next, in the form in which it keeps it. If other steps need it too they find it there.
    pub fn taken(&mut self, register: ValueId, value: ValueId) -> Value {
        let is_new = self.known[value.index()].is_none() && self.is_shared[value.index()];
        self.taken = Some(value).filter(|_| is_new);
        let kept = self.as_kept(register, value);
        if self.taken.take().is_some() {
            let width = self.graph.width(value);
            let lowered = if self.signs.has(register) {
                Lowered::signed(kept, width)
            } else {
                Lowered::below(kept, width)
            };
            self.set(value, lowered);
            self.takers.insert(value, register);
        }
        kept
    }

    fn store_shared(&mut self, value: ValueId, any: Value) {
        if let Some(place) = self.layout.of(value) {
            let state = self.state;
            self.cursor.ins().store(flags(place.width), any, state, place.offset);
        }
    }

    /// A value that is kept.
    fn read_again(&mut self, value: ValueId, lowered: Lowered) -> Lowered {
        let place = self.takers.get(&value).copied().unwrap_or(value);
        let any = match self.layout.of(place) {
            Some(place) if place.width == 1 && lowered.bits <= 1 => {
                let word = self.load(place);
                return self.bit(word, 1);
            }
            Some(Place { offset, width }) => {
                self.cursor.ins().load(lane(width), flags(width), self.state, offset)
            }
            None => self.constant(lane(self.graph.width(value)), 0), // never: it has a place
        };
        Lowered { any, zero: None, sign: None, word: None, is_kept: false, ..lowered }
    }

    /// A choice whose arms are computed only where they are taken.
    fn chosen(&mut self, Choice { bit, one, zero }: Choice, width: u32) -> Lowered {
        let condition = self.condition(bit);
        let arms = [Some(one), zero];
        let blocks = arms.map(|_| self.cursor.func.dfg.make_block());
        let next = self.cursor.func.dfg.make_block();
        let either = self.cursor.func.dfg.append_block_param(next, lane(width));
        self.cursor.ins().brif(condition, blocks[0], &[], blocks[1], &[]);
        let mut of_arms = Vec::new();
        for (arm, block) in arms.into_iter().zip(blocks) {
            let mark = self.enter();
            self.cursor.insert_block(block);
            let lowered = match arm {
                Some(arm) => self.any(arm),
                None => Lowered::below(self.constant(lane(width), 0), 0),
            };
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
        if let Some(read) = self.read_from_array(value, width) {
            return read;
        }
        if let Some(choice) = self.alone.choice(self.graph, value) {
            return self.chosen(choice, width);
        }
        match self.graph.kind(value) {
            Kind::Stored if self.signs.has(value) => Lowered::signed(self.stored(value, width), width),
            Kind::Stored if width == 1 => {
                let word = self.stored(value, width);
                self.bit(word, 1)
            }
            Kind::Stored => Lowered::below(self.stored(value, width), width),
            Kind::Constant(constant) => {
                Lowered::below(self.constant(lane(width), *constant), 128 - constant.leading_zeros())
            }
            Kind::Op(op, operands) => operators::lower(self, *op, width, operands),
        }
    }

    /// The register that a number names, if all that it could name are as they were.
    fn read_from_array(&mut self, value: ValueId, width: u32) -> Option<Lowered> {
        let array = self.tables.array(value)?;
        if array.registers.iter().any(|register| self.changed[register.index()].is_some()) {
            return None;
        }
        let (lowest, words) = array.places(self.layout)?;
        let (state, is_signed) = (self.state, self.signs.has(array.registers[0]));
        let (at, offset) = match (array.table, &words[..]) {
            (Some(table), _) => {
                let index = self.zero(array.index);
                let address = self.cursor.ins().iadd(state, index);
                let offset = self.layout.tables + table as i32;
                let words = self.cursor.ins().uload8(types::I64, MemFlagsData::trusted(), address, offset);
                let three = self.constant(types::I64, 3);
                (self.cursor.ins().ishl(words, three), lowest)
            }
            // To a bit that has to be made a word a choice is as short.
            (None, &[zero, one]) => {
                let bit = self.demand(array.index);
                let bit = bit.word.filter(|_| bit.bits <= 1)?;
                let bytes = (i64::from(one) - i64::from(zero)) * 8;
                (self.cursor.ins().imul_imm_s(bit, bytes), lowest + i32::from(zero) * 8)
            }
            _ => return None,
        };
        let address = self.cursor.ins().iadd(state, at);
        let any = self.cursor.ins().load(lane(width), flags(width), address, offset);
        let widest =
            array.registers.iter().map(|register| self.graph.width(*register)).max().unwrap_or(width);
        Some(if is_signed { Lowered::signed(any, widest) } else { Lowered::below(any, widest) })
    }

    /// An entry of a table.
    fn looked_up(&mut self, table: Table, width: u32) -> Lowered {
        let index = self.zero(table.index);
        let (flags, state, offset) =
            (MemFlagsData::trusted(), self.state, self.layout.tables + table.first as i32);
        let address = self.cursor.ins().iadd(state, index);
        let entry = self.cursor.ins().uload8(types::I64, flags, address, offset);
        if width == 1 { self.bit(entry, 1) } else { Lowered::below(entry, width) }
    }
}

/// No access traps: all places lie within the state. They are aligned to 8 bytes.
pub(super) fn flags(width: u32) -> MemFlagsData {
    if width <= 64 { MemFlagsData::trusted() } else { MemFlagsData::new().with_notrap() }
}
