//! Registers and outputs that take the value of another register, as stages of a queue do. Where two
//! neighbours take the values of two neighbours, one load and one store of 128 bits are enough.

use cranelift_codegen::ir::{InstBuilder, MemFlagsData, types};

use super::program::Lowering;
use crate::graph::{Kind, ValueId};
use crate::groups::{Group, Member};
use crate::layout::Place;

/// From one place to another.
#[derive(Clone, Copy)]
pub(super) struct Copied {
    from: Place,
    to: Place,
}

impl Copied {
    /// Of two neighbours the lower one, if they are neighbours in the same order on both sides.
    fn first(self, other: Copied) -> Option<Copied> {
        let is_next = |low: Copied, high: Copied| {
            high.from.offset - low.from.offset == 8 && high.to.offset - low.to.offset == 8
        };
        [(self, other), (other, self)]
            .into_iter()
            .find(|(low, high)| is_next(*low, *high))
            .map(|(low, _)| low)
    }
}

impl Lowering<'_> {
    /// Copies both at once, if they are neighbours; nothing else may have to be done with them.
    pub(super) fn copy_both(&mut self, [a, b]: [Copied; 2], registers: &[ValueId]) -> bool {
        let Some(Copied { from, to }) = a.first(b).filter(|_| self.v.cursor.has_vectors) else {
            return false;
        };
        // Two words side by side are aligned to 8 bytes, not to 16.
        let (flags, state) = (MemFlagsData::new().with_notrap(), self.v.cursor.state);
        let both = self.v.cursor.ins().load(types::I64X2, flags, state, from.offset);
        let store = self.v.cursor.ins().store(flags, both, state, to.offset);
        registers.iter().for_each(|register| self.v.changes.change(*register, store));
        true
    }

    /// What a member takes at this rank, if that is what another register is, in the form in which it is
    /// kept, and nobody has to know whether it is another value.
    pub(super) fn member_copied(&self, group: &Group, member: &Member, rank: usize) -> Option<Copied> {
        let Member::Register { q, values } = member else { return None };
        let is_compared = self.is_compared(group, rank)
            && (self.v.plan.wakes.mask(*q).is_some()
                || self.v.plan.wakes.of(*q) & !self.v.plan.wakes.own(group.unit) != 0);
        let is_same = self.v.plan.signs.has(*q) == self.v.plan.signs.has(values[rank]);
        let copied = Copied { from: self.in_place(values[rank])?, to: self.v.plan.layout.of(*q)? };
        (is_same && !is_compared).then_some(copied)
    }

    /// An output that is what a register is.
    pub(super) fn output_copied(&self, value: ValueId, to: Place) -> Option<Copied> {
        let from = self.in_place(value).filter(|_| !self.v.plan.signs.has(value))?;
        Some(Copied { from, to })
    }

    /// Where the value is, if it is a register or an input of a word or less that has not changed yet.
    fn in_place(&self, value: ValueId) -> Option<Place> {
        let is_there = *self.v.graph().kind(value) == Kind::Stored && self.v.changes.of(value).is_none();
        self.v.plan.layout.of(value).filter(|place| is_there && place.width <= 64)
    }
}
