//! Registers in the state. A register is stored in place, and read as it was before it changed in the same
//! clock. An old value that is still needed is read just before the change, in the branch that makes it.

use cranelift_codegen::cursor::Cursor;
use cranelift_codegen::ir::Value;

use super::changes::Change;
use super::lowered::lane;
use super::values::Values;
use crate::graph::ValueId;

impl Values<'_> {
    /// Stores the next value of a register.
    pub fn store_register(&mut self, register: ValueId, value: Value) {
        if let Some(place) = self.plan.layout.of(register) {
            let store = self.cursor.write(value, place);
            self.changes.change(register, store);
        }
    }

    /// The value as the register keeps it.
    pub fn as_kept(&mut self, register: ValueId, value: ValueId) -> Value {
        if self.plan.signs.has(register) { self.sign(value) } else { self.zero(value) }
    }

    /// Stores what a register is after a reset, when nobody reads it any more.
    pub fn store_reset(&mut self, register: ValueId, value: u128) {
        if let Some(place) = self.plan.layout.of(register) {
            let sign = 1 << (place.width - 1);
            let value = if self.plan.signs.has(register) { (value ^ sign).wrapping_sub(sign) } else { value };
            let value = self.cursor.constant(lane(place.width), value);
            self.cursor.write(value, place);
        }
    }

    /// An input or the old value of a register; a bit as a word.
    pub fn stored(&mut self, value: ValueId, width: u32) -> Value {
        let Some(place) = self.plan.layout.of(value) else {
            return self.cursor.constant(lane(width.max(2)), 0); // never: the layout has all that is stored
        };
        let Some(Change { branch, at }) = self.changes.of(value) else {
            return self.cursor.load(place);
        };
        if let Some(old) = self.changes.old.get(&value) {
            return *old;
        }
        let here = self.cursor.position();
        self.cursor.goto_inst(at);
        let old = self.cursor.load(place);
        self.cursor.set_position(here);
        self.changes.old.insert(value, old);
        self.changes.branches[branch].old.push(value);
        old
    }
}
