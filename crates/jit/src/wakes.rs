//! The units of a design that can stand still: what wakes each of them, and for how long.

use std::collections::HashMap;

use crate::graph::ValueId;
use crate::idle_state::IdleState;

/// Units with a counter, a bit each in a set of units; those beyond them never stand still.
pub(crate) const MOST: usize = 64;

/// Clocks after a change for which a unit's own seeds are not compared: most often the next change comes
/// within them.
pub(crate) const UNASKED: u8 = 4;

/// For each value the units that have to know of a change, and for how long.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wakes {
    /// The units that have to know that a register or an input has changed.
    pub stored: HashMap<ValueId, u64>,
    /// Of each runner its mask, and the unit that has to know of it while the mask is 1.
    pub masks: HashMap<ValueId, (ValueId, u64)>,
    /// Of each unit, the clocks that it works on after a change; 0 for one that never stands still.
    pub clocks: Vec<u8>,
    /// The units that can.
    pub resting: u64,
    /// Of each unit.
    pub gates: Vec<Vec<ValueId>>,
    /// Of each unit, its own seeds that are compared.
    pub compared: Vec<Vec<ValueId>>,
    pub idle: IdleState,
}

impl Wakes {
    /// The units that have to know that this register or input has changed.
    pub fn of(&self, stored: ValueId) -> u64 {
        self.stored.get(&stored).copied().unwrap_or(0)
    }

    /// The mask of a runner, and the unit that works on while it is 1.
    pub fn mask(&self, runner: ValueId) -> Option<(ValueId, u64)> {
        self.masks.get(&runner).copied()
    }

    /// Whether the unit can stand still.
    pub fn rests(&self, unit: usize) -> bool {
        self.clocks.get(unit).is_some_and(|clocks| *clocks > 0)
    }

    /// The gates of a unit.
    pub fn gates(&self, unit: usize) -> &[ValueId] {
        self.gates.get(unit).map_or(&[], Vec::as_slice)
    }

    /// The gates of all units.
    pub fn all_gates(&self) -> Vec<ValueId> {
        self.gates.concat()
    }

    /// The seeds of a unit that are compared with what they were.
    pub fn compared(&self, unit: usize) -> &[ValueId] {
        self.compared.get(unit).map_or(&[], Vec::as_slice)
    }

    /// The largest counter with which they are: all that follow are clocks without any other change. In the
    /// first of them there is no clock before to compare with.
    pub fn asked_from(&self, unit: usize) -> u8 {
        self.clocks[unit] - UNASKED
    }

    /// Whether the condition holds while nothing is to be done. What changes under it, and within no other
    /// one, is compared with what it was; else it counts as changed.
    pub fn is_idle(&self, condition: ValueId) -> bool {
        self.idle.holds(condition)
    }

    /// The set of a unit alone; none if it never stands still.
    pub fn own(&self, unit: usize) -> u64 {
        self.resting & 1u64.checked_shl(unit as u32).unwrap_or(0)
    }

    /// The units of a set that can stand still, with their clocks.
    #[inline]
    pub fn units(&self, set: u64) -> impl Iterator<Item = (usize, u8)> {
        let mut left = set & self.resting;
        std::iter::from_fn(move || {
            let unit = left.trailing_zeros() as usize;
            (left != 0).then(|| {
                left &= left - 1;
                (unit, self.clocks[unit])
            })
        })
    }
}
