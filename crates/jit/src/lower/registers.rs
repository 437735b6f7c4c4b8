//! Registers in the state: stored in place, and read as they were before they changed in the same clock. An old value that is still
//! needed is read just before the change, in the branch that makes it.

use cranelift_codegen::cursor::Cursor;
use cranelift_codegen::ir::{Inst, InstBuilder, Value};

use super::lowered::lane;
use super::values::{Values, flags};
use crate::graph::ValueId;

/// Where a register changes.
#[derive(Clone, Copy)]
pub(super) struct Change {
    /// The number of the branch that knows it.
    pub branch: usize,
    /// The store, or what leads into the branch that has it; before it the state has the old value.
    pub at: Inst,
}

/// Code that is skipped as a whole, or the function.
#[derive(Default)]
pub(super) struct Branch {
    /// Registers that change in it.
    pub changed: Vec<ValueId>,
    /// Those of which it has read the old value.
    pub old: Vec<ValueId>,
    /// By the units that have to know.
    pub differences: Vec<Difference>,
}

/// What is not 0 if something has changed that these units have to know.
pub(super) struct Difference {
    pub units: u64,
    pub any: Value,
    /// Of so many registers.
    pub count: usize,
}

impl Values<'_> {
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

    /// An input or the old value of a register; a bit as a word.
    pub fn stored(&mut self, value: ValueId, width: u32) -> Value {
        let Some(place) = self.layout.of(value) else {
            return self.constant(lane(width.max(2)), 0); // never: the layout has all that is stored
        };
        let Some(Change { branch, at }) = self.changed[value.index()] else {
            return self.load(place);
        };
        if let Some(old) = self.old.get(&value) {
            return *old;
        }
        let here = self.cursor.position();
        self.cursor.goto_inst(at);
        let old = self.load(place);
        self.cursor.set_position(here);
        self.old.insert(value, old);
        self.branches[branch].old.push(value);
        old
    }
}
