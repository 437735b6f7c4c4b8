//! A step of a clock: a change, or steps behind a condition.

use crate::design::Design;
use crate::graph::ValueId;
use crate::groups::{Group, Member};

/// A step of a clock.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// What changes under conditions.
    Change(Group),
    /// The writes to a memory.
    Write(usize),
    /// Bits are worked out and kept, before what they follow from changes.
    Early(Vec<ValueId>),
    /// All steps of a unit, which are left out while it stands still. Its gates are asked in every clock.
    Unit { unit: usize, gates: Vec<ValueId>, then: Vec<Step> },
    /// Steps for when this bit is 1.
    If { bit: ValueId, then: Vec<Step> },
}

impl Step {
    /// All values that the step asks for, without those of steps in it.
    pub fn asked(&self, design: &Design) -> Vec<ValueId> {
        match self {
            Step::Change(group) => {
                let mut asked = group.conditions.clone();
                for member in &group.members {
                    match member {
                        Member::Register { values, .. } => asked.extend(values),
                        Member::Read { memory, port } => {
                            asked.push(design.memories[*memory].reads[*port].addr)
                        }
                    }
                }
                asked
            }
            Step::Write(memory) => {
                let writes = design.memories[*memory].writes.iter();
                writes.flat_map(|write| [write.en, write.addr, write.data]).collect()
            }
            Step::Early(bits) => bits.clone(),
            Step::Unit { gates, .. } => gates.clone(),
            Step::If { bit, .. } => vec![*bit],
        }
    }
}
