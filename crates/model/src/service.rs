//! How long a memory works on accesses that never keep it waiting.
//!
//! ```text
//!  accesses in their order ─> each as soon as the port is free ─> clocks of the port
//! ```
//! Of memories that stall at random these are the clocks to be expected.

use crate::waits::{Fixed, Pacer, Stalls, Waits};

/// A memory whose ports are offered the next access as soon as they are free.
#[derive(Clone, Debug)]
pub(crate) struct Service {
    waits: Waits,
    /// Reads and writes so far.
    accesses: [u64; 2],
    /// Of a dynamic memory, whose ports share one controller.
    pacer: Pacer,
    /// Clocks of the controller so far.
    now: u64,
}

impl Service {
    /// Nothing was accessed.
    pub fn new(waits: Waits) -> Self {
        Service { waits, accesses: [0; 2], pacer: Pacer::new(waits), now: 0 }
    }

    /// Addresses that the machine read and wrote in one cycle.
    #[inline(always)]
    pub fn access(&mut self, read: Option<u32>, write: Option<u32>) {
        if read.is_none() && write.is_none() {
            return;
        }
        let [reads, writes] = &mut self.accesses;
        *reads += u64::from(read.is_some());
        *writes += u64::from(write.is_some());
        if matches!(self.waits, Waits::Dram(_)) {
            self.pacer.step(self.now, read, write);
            self.now = self.pacer.free();
        }
    }

    /// The ports are one controller.
    pub fn is_shared(&self) -> bool {
        matches!(self.waits, Waits::Dram(_))
    }

    /// Clocks of the read port and of the write port; of one controller the first.
    pub fn clocks(&self) -> [u64; 2] {
        let [reads, writes] = self.accesses;
        match self.waits {
            Waits::Never => [reads, writes],
            Waits::Fixed(Fixed { rd, wr, .. }) => [reads * (1 + u64::from(rd)), writes * (1 + u64::from(wr))],
            Waits::Random(Stalls { rd, wr, .. }) => {
                let of = |count: u64, share: u8| count * 256 / (256 - u64::from(share));
                [of(reads, rd), of(writes, wr)]
            }
            Waits::Dram(_) => [self.now, 0],
        }
    }
}

/// Clocks of a memory that reads these addresses one after the other, or writes them, and does nothing else.
#[must_use]
pub fn clocks_alone(waits: Waits, addresses: impl IntoIterator<Item = u32>, writes: bool) -> u64 {
    let mut service = Service::new(waits);
    for addr in addresses {
        if writes { service.access(None, Some(addr)) } else { service.access(Some(addr), None) }
    }
    let [first, second] = service.clocks();
    first.max(second)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clocks(waits: &str, accesses: &[(Option<u32>, Option<u32>)]) -> [u64; 2] {
        let mut service = Service::new(waits.parse().expect(waits));
        accesses.iter().for_each(|(read, write)| service.access(*read, *write));
        service.clocks()
    }

    #[test]
    fn service_of_accesses_is_as_by_hand() {
        let accesses = [(Some(0), None), (Some(1), Some(0)), (None, Some(300)), (None, None)];
        assert_eq!(clocks("none", &accesses), [2, 2]);
        assert_eq!(clocks("fixed:rd=2,data=9,wr=0", &accesses), [6, 2]);
        assert_eq!(clocks("random:rd=128,wr=64", &accesses), [4, 2]);
        // A miss 1 + 6; a hit 1, a turn and a hit 1 + 2; another bank's page 1 + 6.
        let dram = "dram:banks=4,page=256,miss=6,turn=2,refresh=0,busy=13";
        assert_eq!(clocks(dram, &accesses), [7 + 1 + 3 + 7, 0]);
        // The refresh of cycle 7 comes with the second access, closes the pages and takes 6 clocks.
        let refreshed = "dram:banks=4,page=256,miss=6,turn=2,refresh=7,busy=6";
        assert_eq!(clocks(refreshed, &accesses[..2]), [7 + 1 + 3 + 6, 0]);
        // Every clock of the memory twice as long.
        let slow = "dram:banks=4,page=256,miss=12,turn=4,refresh=0,word=2";
        assert_eq!(clocks(slow, &accesses), [2 * (7 + 1 + 3 + 7), 0]);
    }

    #[test]
    fn lines_bring_bursts_and_gather_writes() {
        let dram = "dram:banks=4,page=256,miss=6,turn=2,refresh=0,word=3,line=4";
        let (read, write) = (|addr| (Some(addr), None), |addr| (None, Some(addr)));
        // A miss and four words of three clocks; words of the line, a clock each.
        assert_eq!(clocks(dram, &[read(5)]), [6 + 4 * 3, 0]);
        assert_eq!(clocks(dram, &[read(5), read(4), read(7)]), [6 + 4 * 3 + 2, 0]);
        // Writes into one line take a clock each, and nothing is written yet.
        assert_eq!(clocks(dram, &[write(8), write(9), write(9)]), [3, 0]);
        // The write to another line turns, opens the page and writes the two words of the first.
        assert_eq!(clocks(dram, &[write(8), write(9), write(12)]), [2 + 2 + 6 + 2 * 3 + 1, 0]);
        // A read of the line that gathers writes it before; the page is open then, and the bus turns back.
        assert_eq!(clocks(dram, &[write(8), read(10)]), [1 + 2 + 6 + 3 + 2 + 4 * 3, 0]);
    }
}
