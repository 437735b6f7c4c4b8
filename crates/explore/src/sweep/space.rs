//! All machines that the values of the varied keys make. A key of a unit that a machine has not tells it from no other: of
//! combinations that are the same machine one counts, that with the first values of such keys.

use super::axis::Axis;
use edgewalk_machine::Machine;

/// Most combinations that are looked at one by one. A sweep of more has to be a sample or a search.
const MOST_LISTED: u64 = 1 << 20;

/// All machines of a sweep.
pub struct Space {
    /// How many combinations the values make, at most the largest number there is.
    combinations: u64,
    /// The indices of the combinations that count, where these are listed and are not all.
    listed: Option<Vec<u64>>,
}

impl Space {
    /// All machines that the values of `axes` make of this one.
    #[must_use]
    pub fn new(base: &Machine, axes: &[Axis]) -> Space {
        let combinations = axes.iter().map(|axis| axis.values.len() as u64).fold(1, u64::saturating_mul);
        let listed = (combinations <= MOST_LISTED).then(|| {
            (0..combinations).filter(|index| first_alike(base, axes, *index) == *index).collect::<Vec<_>>()
        });
        let listed = listed.filter(|list| (list.len() as u64) < combinations);
        Space { combinations, listed }
    }

    /// How many machines there are. Of combinations too many to be listed it is the number of these.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.listed.as_ref().map_or(self.combinations, |list| list.len() as u64)
    }

    /// The word for these: machines, or combinations where they are too many to be listed.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        if self.combinations > MOST_LISTED { "combinations" } else { "machines" }
    }

    /// The index of a machine by its place below [`Space::count`].
    #[must_use]
    pub fn index(&self, base: &Machine, axes: &[Axis], place: u64) -> u64 {
        match &self.listed {
            Some(list) => list[place as usize],
            None => first_alike(base, axes, place),
        }
    }
}

/// The machine with this index among all combinations: the last key changes fastest.
#[must_use]
pub fn machine(base: &Machine, axes: &[Axis], index: u64) -> Machine {
    let mut machine = base.clone();
    let mut rest = index;
    for axis in axes.iter().rev() {
        let count = axis.values.len() as u64;
        (axis.key.set)(&mut machine, axis.values[(rest % count) as usize]);
        rest /= count;
    }
    machine
}

/// The index of the combination that counts, of those that are the same machine as this one.
#[must_use]
pub fn first_alike(base: &Machine, axes: &[Axis], index: u64) -> u64 {
    let machine = machine(base, axes, index);
    let (mut first, mut rest, mut weight) = (0, index, 1);
    for axis in axes.iter().rev() {
        let count = axis.values.len() as u64;
        if (axis.key.used)(&machine) {
            first += rest % count * weight;
        }
        rest /= count;
        weight *= count;
    }
    first
}
