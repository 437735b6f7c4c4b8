//! What is known of each value where the cursor stands, and what is kept in the state for the steps that
//! follow.

use std::collections::HashMap;

use super::lowered::Lowered;
use crate::graph::{Graph, ValueId};

/// What is known of each value.
pub(super) struct Known {
    lowered: Vec<Option<Lowered>>,
    is_shared: Vec<bool>,
    /// What was known before, since the outermost branch began.
    undo: Vec<(ValueId, Option<Lowered>)>,
    /// What a register takes next: it is kept there, if it is kept.
    pub taken: Option<ValueId>,
    /// The registers that have taken values which are kept.
    pub takers: HashMap<ValueId, ValueId>,
}

impl Known {
    /// Nothing is known yet.
    pub fn new(graph: &Graph) -> Known {
        Known {
            lowered: vec![None; graph.len()],
            is_shared: vec![false; graph.len()],
            undo: Vec::new(),
            taken: None,
            takers: HashMap::new(),
        }
    }

    /// The value, if it is known.
    pub fn get(&self, value: ValueId) -> Option<Lowered> {
        self.lowered[value.index()]
    }

    /// The value is known from now on.
    pub fn set(&mut self, value: ValueId, lowered: Lowered) {
        let before = self.lowered[value.index()].replace(lowered);
        self.undo.push((value, before));
    }

    /// The value is kept in the state when it is computed.
    pub fn is_shared(&self, value: ValueId) -> bool {
        self.is_shared[value.index()]
    }

    /// Marks values that are kept in the state when they are computed.
    pub fn keep(&mut self, shared: &[ValueId]) {
        shared.iter().for_each(|value| self.is_shared[value.index()] = true);
    }

    /// What becomes known from now on is forgotten at [`Known::leave`].
    pub fn enter(&self) -> usize {
        self.undo.len()
    }

    /// Forgets what became known since [`Known::enter`] returned `mark`.
    pub fn leave(&mut self, mark: usize) {
        for (value, before) in self.undo.drain(mark..).rev() {
            self.lowered[value.index()] = before;
        }
    }

    /// Between two steps: what they share is in the state, and registers of the processor are free.
    pub fn forget(&mut self, graph: &Graph) {
        for value in graph.ids() {
            if let Some(lowered) = self.get(value).filter(|lowered| !lowered.is_kept) {
                let kept = self.is_shared(value).then_some(Lowered { is_kept: true, ..lowered });
                self.undo.push((value, Some(lowered)));
                self.lowered[value.index()] = kept;
            }
        }
    }
}
