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

/// Adds all numbers of the other set.
pub(crate) fn unite(set: &mut Set, other: &Set) {
    set.iter_mut().zip(other).for_each(|(a, b)| *a |= b);
}

/// The numbers that are in both sets.
pub(crate) fn members<'s>(a: &'s Set, b: &'s Set) -> impl Iterator<Item = usize> + 's {
    let both = a.iter().zip(b).map(|(a, b)| a & b).enumerate();
    both.flat_map(|(word, bits)| {
        (0..64).filter(move |bit| bits >> bit & 1 == 1).map(move |bit| word * 64 + bit)
    })
}

/// The number is in the set.
pub(crate) fn contains(set: &Set, number: usize) -> bool {
    set[number / 64] >> (number % 64) & 1 == 1
}

/// Puts a number into the set.
pub(crate) fn insert(set: &mut Set, number: usize) {
    set[number / 64] |= 1 << (number % 64);
}
