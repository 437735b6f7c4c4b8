//! What a step reads and changes, for the order of steps.

/// A set of registers and inputs, a bit each.
pub(crate) type Set = Vec<u64>;

/// What a step does, with all within it.
pub(crate) struct Effect {
    pub reads: Set,
    pub writes: Set,
    /// Memories of which it reads words, a bit each.
    pub looks: Set,
    /// The memory of which it writes words.
    pub fills: Option<usize>,
}

impl Effect {
    pub fn unite(&mut self, other: &Effect) {
        unite(&mut self.reads, &other.reads);
        unite(&mut self.writes, &other.writes);
        unite(&mut self.looks, &other.looks);
    }

    /// The other one has to be first: it reads words as they are before this one.
    pub fn waits_for(&self, other: &Effect) -> bool {
        self.fills.is_some_and(|memory| other.looks[memory / 64] >> (memory % 64) & 1 == 1)
    }
}

pub(crate) fn unite(set: &mut Set, other: &Set) {
    set.iter_mut().zip(other).for_each(|(a, b)| *a |= b);
}
