//! A step of a clock: a change, or steps behind a condition.

use crate::graph::ValueId;
use crate::groups::Group;

/// A step of a clock.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// What changes under conditions.
    Change(Group),
    /// The writes to a memory.
    Write(usize),
    /// All steps of a unit, which are left out while it stands still.
    Unit { unit: usize, then: Vec<Step> },
    /// Steps for when this bit is 1.
    If { bit: ValueId, then: Vec<Step> },
}

impl Step {
    /// The bits that the step asks first.
    pub fn conditions(&self) -> &[ValueId] {
        match self {
            Step::Change(group) => &group.conditions,
            Step::Write(_) | Step::Unit { .. } => &[],
            Step::If { bit, .. } => std::slice::from_ref(bit),
        }
    }
}
