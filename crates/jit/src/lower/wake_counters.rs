//! The counters of units: what sets them, and what is compared before one of them comes to 0.

use cranelift_codegen::cursor::Cursor;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Value, types};

use super::changes::Difference;
use super::cursor::flags;
use super::values::Values;
use crate::graph::ValueId;
use crate::layout::{Compared, PAIR, Place};

/// Clocks more for a unit that was asked and found at work: most often it goes on.
const AT_WORK: u8 = 12;

impl Values<'_> {
    /// The units have to know if the register, which is to be stored, changes; the one of a runner while it
    /// is not masked.
    pub fn compare(&mut self, register: ValueId, value: Value, units: u64) {
        if let Some((mask, unit)) = self.plan.wakes.mask(register) {
            let mask = self.zero(mask);
            let mask = self.cursor.resized(mask, types::I64);
            self.differ(mask, unit);
        }
        let Some(place) =
            self.plan.layout.of(register).filter(|_| self.plan.wakes.units(units).next().is_some())
        else {
            return;
        };
        let ty = self.cursor.type_of(value);
        let old = self.cursor.read(ty, place);
        let mut difference = self.cursor.ins().bxor(old, value);
        if ty == types::I128 {
            let (low, high) = self.cursor.ins().isplit(difference);
            difference = self.cursor.ins().bor(low, high);
        }
        let difference = self.cursor.resized(difference, types::I64);
        self.differ(difference, units);
    }

    /// The units have to know if this is not 0.
    fn differ(&mut self, difference: Value, units: u64) {
        let branch = self.changes.branches.len() - 1;
        let all = &mut self.changes.branches[branch].differences;
        let Some(same) = all.iter_mut().find(|same| same.units == units) else {
            return all.push(Difference { units, any: difference, count: 1 });
        };
        let any = self.cursor.ins().bor(same.any, difference);
        (same.any, same.count) = (any, same.count + 1);
        if same.count % 2 == 0 {
            // Nobody reads it there, but for a store it has to be worked out here: else the code generator
            // keeps what all of the registers were and what they are till the branch ends.
            let unread = Place { offset: self.plan.layout.unread, width: 64 };
            self.cursor.write(any, unread);
        }
    }

    /// At the end of a branch: the units work on that have to know what has changed in it.
    pub fn wake_changed(&mut self) {
        let branch = self.changes.branches.len() - 1;
        for Difference { units, any: difference, .. } in
            std::mem::take(&mut self.changes.branches[branch].differences)
        {
            for (unit, clocks) in self.plan.wakes.units(units) {
                let (before, all) = (self.clocks(unit), self.cursor.constant(types::I8, clocks.into()));
                let clocks = self.cursor.ins().select(difference, all, before);
                self.set_clocks(unit, clocks);
            }
        }
    }

    /// Marks these units as working.
    pub fn wake(&mut self, units: u64) {
        for (unit, clocks) in self.plan.wakes.units(units) {
            let clocks = self.cursor.constant(types::I8, clocks.into());
            self.set_clocks(unit, clocks);
        }
    }

    /// For how many clocks a unit is to work, this one too: for all of them if a bit from another unit is not
    /// what it was.
    pub fn clocks_now(&mut self, unit: usize) -> Value {
        let mut changed = None;
        for (gate, place) in self.plan.wakes.gates(unit).iter().zip(&self.plan.layout.gates[unit]) {
            let now = self.zero(*gate);
            let before = self.cursor.read(types::I8, *place);
            self.cursor.write(now, *place);
            let differs = self.cursor.ins().bxor(now, before);
            changed = Some(changed.map_or(differs, |changed| self.cursor.ins().bor(changed, differs)));
        }
        let clocks = self.clocks(unit);
        let Some(changed) = changed else { return clocks };
        let all = self.cursor.constant(types::I8, self.plan.wakes.clocks[unit].into());
        self.cursor.ins().select(changed, all, clocks)
    }

    /// For how many clocks a unit is to work on.
    pub fn clocks(&mut self, unit: usize) -> Value {
        self.cursor.read(types::I8, self.counter(unit))
    }

    /// One clock less than so many.
    pub fn count(&mut self, unit: usize, clocks: Value) {
        let one = self.cursor.constant(types::I8, 1);
        let clocks = self.cursor.ins().isub(clocks, one);
        self.set_clocks(unit, clocks);
    }

    fn set_clocks(&mut self, unit: usize, clocks: Value) {
        self.cursor.write(clocks, self.counter(unit));
    }

    /// The place of a unit's counter, a byte.
    fn counter(&self, unit: usize) -> Place {
        Place { offset: self.plan.layout.counters + unit as i32, width: 8 }
    }

    /// Before a unit works: for how many clocks it is to. When no change has set its counter for a while its
    /// own seeds are compared with what they were in the clock before; all of them if one has changed.
    pub fn asked(&mut self, unit: usize, clocks: Value) -> Value {
        let Compared { offset, copy, bytes } = self.plan.layout.compared[unit];
        if bytes == 0 {
            return clocks;
        }
        let state = self.cursor.state;
        let [seldom, copied, word, same, next] = [(); 5].map(|()| self.cursor.func.dfg.make_block());
        [seldom, copied, word, same].into_iter().for_each(|block| self.cursor.func.layout.set_cold(block));
        let [from, at] =
            [copied, word].map(|block| self.cursor.func.dfg.append_block_param(block, types::I64));
        let either = self.cursor.func.dfg.append_block_param(next, types::I8);
        let first = self.cursor.constant(types::I8, self.plan.wakes.asked_from(unit).into());
        let is_asked = self.cursor.ins().icmp(IntCC::UnsignedLessThanOrEqual, clocks, first);
        self.cursor.ins().brif(is_asked, seldom, &[], next, &[clocks.into()]);

        self.cursor.insert_block(seldom);
        let (zero, end) =
            (self.cursor.constant(types::I64, 0), self.cursor.constant(types::I64, bytes as u128));
        let is_first = self.cursor.ins().icmp(IntCC::Equal, clocks, first);
        self.cursor.ins().brif(is_first, copied, &[zero.into()], word, &[zero.into()]);

        // Loops, as it is seldom done, and short code is compiled sooner. Two words side by side are aligned
        // to 8 bytes, not to 16.
        self.cursor.insert_block(copied);
        let address = self.cursor.ins().iadd(state, from);
        let (pair, unaligned) = (
            if self.cursor.has_vectors { types::I64X2 } else { types::I128 },
            MemFlagsData::new().with_notrap(),
        );
        let now = self.cursor.ins().load(pair, unaligned, address, offset);
        self.cursor.ins().store(unaligned, now, address, copy);
        let following = self.cursor.ins().iadd_imm_s(from, i64::from(PAIR));
        let goes_on = self.cursor.ins().icmp(IntCC::UnsignedLessThan, following, end);
        self.cursor.ins().brif(goes_on, copied, &[following.into()], next, &[clocks.into()]);

        // To the first that differs: then all are copied anew before they are compared again.
        self.cursor.insert_block(word);
        let address = self.cursor.ins().iadd(state, at);
        let now = self.cursor.ins().load(types::I64, flags(64), address, offset);
        let before = self.cursor.ins().load(types::I64, flags(64), address, copy);
        let differs = self.cursor.ins().icmp(IntCC::NotEqual, now, before);
        let all = self.cursor.constant(types::I8, (self.plan.wakes.clocks[unit] + AT_WORK).into());
        self.cursor.ins().brif(differs, next, &[all.into()], same, &[]);
        self.cursor.insert_block(same);
        let following = self.cursor.ins().iadd_imm_s(at, 8);
        let goes_on = self.cursor.ins().icmp(IntCC::UnsignedLessThan, following, end);
        self.cursor.ins().brif(goes_on, word, &[following.into()], next, &[clocks.into()]);

        self.cursor.insert_block(next);
        either
    }
}
