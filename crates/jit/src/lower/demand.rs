//! Computes a value when it is asked for, with all that it needs: by its operator, from a table, or from
//! where it lies.

use cranelift_codegen::cursor::Cursor;
use cranelift_codegen::ir::{InstBuilder, Value, types};
use edgewalk_netlist::Op;

use super::cursor::flags;
use super::lowered::{Lowered, lane};
use super::operators;
use super::plan::Plan;
use super::values::Values;
use crate::graph::{Kind, ValueId};
use crate::places::Places;
use crate::sink::Choice;
use crate::tables::Table;

impl Values<'_> {
    /// Computes the value and all it needs. Depth first with its own stack: a chain of operators can be long.
    pub fn demand(&mut self, value: ValueId) -> Lowered {
        let mut stack = vec![value];
        loop {
            // The stack has an entry until the value that was asked for is known.
            let value = stack[stack.len() - 1];
            if let Some(mut lowered) = self.known.get(value) {
                if lowered.is_kept {
                    lowered = self.read_again(value, lowered);
                    self.known.set(value, lowered);
                }
                stack.pop();
                if stack.is_empty() {
                    return lowered;
                }
                continue;
            }
            let waiting = stack.len();
            let before = self.sink.before(self.graph(), &self.plan.tables, value);
            let decides = self.graph().as_op(value, Op::Mux).and_then(|operands| operands.first().copied());
            let waits = |operand: &ValueId| {
                let is_tested = decides == Some(*operand) && self.tested_in_place(*operand).is_some();
                self.known.get(*operand).is_none() && !is_tested
            };
            stack.extend(before.into_iter().rev().filter(waits));
            if stack.len() == waiting {
                let lowered = self.compute(value);
                self.known.set(value, lowered);
                if self.known.is_shared(value) && self.known.taken != Some(value) {
                    self.known.takers.remove(&value);
                    self.store_shared(value, lowered.any);
                }
            }
        }
    }

    /// What a register takes next, in the form in which it keeps it. If other steps need it too they find it
    /// there.
    pub fn taken(&mut self, register: ValueId, value: ValueId) -> Value {
        let is_new = self.known.get(value).is_none() && self.known.is_shared(value);
        self.known.taken = Some(value).filter(|_| is_new);
        let kept = self.as_kept(register, value);
        if self.known.taken.take().is_some() {
            let width = self.graph().width(value);
            let lowered = if self.plan.signs.has(register) {
                Lowered::signed(kept, width)
            } else {
                Lowered::below(kept, width)
            };
            self.known.set(value, lowered);
            self.known.takers.insert(value, register);
        }
        kept
    }

    fn store_shared(&mut self, value: ValueId, any: Value) {
        if let Some(place) = self.plan.layout.of(value) {
            self.cursor.write(any, place);
        }
    }

    /// A value that is kept.
    fn read_again(&mut self, value: ValueId, lowered: Lowered) -> Lowered {
        let place = self.known.takers.get(&value).copied().unwrap_or(value);
        let any = match self.plan.layout.of(place) {
            Some(place) if place.width == 1 && lowered.bits <= 1 => {
                let word = self.cursor.load(place);
                return self.cursor.bit(word, 1);
            }
            Some(place) => self.cursor.read(lane(place.width), place),
            None => self.cursor.constant(lane(self.graph().width(value)), 0), // never: it has a place
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
            let mark = self.known.enter();
            self.cursor.insert_block(block);
            let lowered = match arm {
                Some(arm) => self.any(arm),
                None => Lowered::below(self.cursor.constant(lane(width), 0), 0),
            };
            of_arms.push(lowered);
            self.cursor.ins().jump(next, &[lowered.any.into()]);
            self.known.leave(mark);
        }
        self.cursor.insert_block(next);
        Lowered::either(either, of_arms[0], of_arms[1])
    }

    fn compute(&mut self, value: ValueId) -> Lowered {
        let width = self.graph().width(value);
        if let Some(table) = self.plan.tables.get(value) {
            return self.looked_up(table, width);
        }
        if let Some(read) = self.read_from_array(value, width) {
            return read;
        }
        if let Some(choice) = self.sink.choice(self.graph(), value) {
            return self.chosen(choice, width);
        }
        match self.graph().kind(value) {
            Kind::Stored if self.plan.signs.has(value) => Lowered::signed(self.stored(value, width), width),
            Kind::Stored if width == 1 => {
                let word = self.stored(value, width);
                self.cursor.bit(word, 1)
            }
            Kind::Stored => Lowered::below(self.stored(value, width), width),
            Kind::Constant(constant) => {
                Lowered::below(self.cursor.constant(lane(width), *constant), 128 - constant.leading_zeros())
            }
            Kind::Op(op, operands) => operators::lower(self, *op, width, operands),
        }
    }

    /// The register that a number names, if all that it could name are as they were.
    fn read_from_array(&mut self, value: ValueId, width: u32) -> Option<Lowered> {
        let Plan { tables, arrays, signs, layout, .. } = self.plan;
        let (array, graph) = (tables.array(value)?, self.graph());
        if array.registers.iter().any(|register| self.changes.of(*register).is_some()) {
            return None;
        }
        let Places { lowest, words, table } = arrays.of(value)?;
        let (at, offset) = match (table, &words[..]) {
            (Some(table), _) => {
                let index = self.zero(array.index);
                let words = self.cursor.read_byte(layout.tables + *table as i32, index);
                let three = self.cursor.constant(types::I64, 3);
                (self.cursor.ins().ishl(words, three), *lowest)
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
        let state = self.cursor.state;
        let address = self.cursor.ins().iadd(state, at);
        let any = self.cursor.ins().load(lane(width), flags(width), address, offset);
        let widest = array.registers.iter().map(|register| graph.width(*register)).max().unwrap_or(width);
        let is_signed = signs.has(array.registers[0]);
        Some(if is_signed { Lowered::signed(any, widest) } else { Lowered::below(any, widest) })
    }

    /// An entry of a table.
    fn looked_up(&mut self, table: Table, width: u32) -> Lowered {
        let index = self.zero(table.index);
        let entry = self.cursor.read_byte(self.plan.layout.tables + table.first as i32, index);
        if width == 1 { self.cursor.bit(entry, 1) } else { Lowered::below(entry, width) }
    }
}
