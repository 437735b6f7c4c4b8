//! What LOAD waits for: the polygon that PASS and MOVER walk.

/// What LOAD sees of the polygon that is walked.
#[derive(Clone, Debug, Default)]
pub(super) struct Walking {
    /// The first cycle in which PASS and MOVER rest.
    pub rests: u64,
    /// The cycles in which PASS writes, and the place of the first that LOAD has not seen.
    pub writes: Vec<u64>,
    pub seen: usize,
}

impl Walking {
    /// The first cycle from this one on in which the edge table can be written.
    #[inline(always)]
    pub(super) fn free_from(&mut self, mut cycle: u64) -> u64 {
        while let Some(write) = self.writes.get(self.seen).filter(|write| **write <= cycle) {
            cycle += u64::from(*write == cycle);
            self.seen += 1;
        }
        cycle
    }
}
