//! What is to be seen of a read-modify-write.

use super::Rmw;

/// An access in flight.
pub(crate) struct Flight<'a, T, S> {
    pub addr: u32,
    pub side: &'a S,
    /// The old word, where it comes from an older access.
    pub forward: Option<T>,
}

impl<T: Copy + Default, S: Copy + Default> Rmw<T, S> {
    /// Places of the queue.
    pub(crate) fn places(&self) -> usize {
        self.depth
    }

    /// The access `place` behind the oldest.
    pub(crate) fn flight(&self, place: usize) -> Option<Flight<'_, T, S>> {
        let slot = self.slot(place);
        let forward = self.forwarded[slot].then_some(self.forward[slot]);
        (place < self.len).then(|| Flight { addr: self.addr[slot], side: &self.side[slot], forward })
    }
}
