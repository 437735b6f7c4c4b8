//! Registers that have changed in this clock, by the branches in which they did.

use std::collections::HashMap;

use cranelift_codegen::ir::{Inst, Value};

use crate::graph::{Graph, ValueId};

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
    /// Values of which the branch has read the old value.
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

/// What has changed where the cursor stands.
pub(super) struct Changes {
    /// The function and the branches within each other in which the cursor stands.
    pub branches: Vec<Branch>,
    /// Where each register changed of which the state may have the new value by now.
    pub changed: Vec<Option<Change>>,
    /// The old values of those, read just before they change.
    pub old: HashMap<ValueId, Value>,
}

impl Changes {
    /// Nothing has changed yet.
    pub fn new(graph: &Graph) -> Changes {
        Changes { branches: vec![Branch::default()], changed: vec![None; graph.len()], old: HashMap::new() }
    }

    /// Where this register changed, if the state may have its new value.
    pub fn of(&self, register: ValueId) -> Option<Change> {
        self.changed[register.index()]
    }

    /// Code begins that may be skipped.
    pub fn enter_branch(&mut self) {
        self.branches.push(Branch::default());
    }

    /// The end of the branch that was entered last: of what changed in it nothing has changed on other ways.
    /// Returns that.
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

    /// The state may have the new value of this register from `at` on.
    pub fn change(&mut self, register: ValueId, at: Inst) {
        let branch = self.branches.len() - 1;
        self.changed[register.index()] = Some(Change { branch, at });
        self.branches[branch].changed.push(register);
    }
}
