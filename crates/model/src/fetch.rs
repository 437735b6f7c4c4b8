//! Fetches a run of words from a memory, for TERM, NORMAL and SHADE.
//!
//! ```text
//!  begin ─> read 0 .. length-1, one a clock; words come in order ─> done with the last
//! ```

/// State of a fetch.
#[derive(Clone, Debug)]
pub(crate) struct Fetch {
    length: u32,
    loading: bool,
    /// i and j: reads sent, words come.
    read: u32,
    come: u32,
}

impl Fetch {
    /// At rest; it fetches so many words at a time.
    pub fn of(length: u32) -> Fetch {
        Fetch { length, loading: false, read: 0, come: 0 }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.loading = false;
    }

    /// From the next cycle on it reads.
    pub fn begin(&mut self) {
        self.loading = true;
        (self.read, self.come) = (0, 0);
    }

    /// Words are on their way, or to be asked for; the memory's word is taken.
    pub fn loading(&self) -> bool {
        self.loading
    }

    /// Number of the word to be read.
    pub fn read(&self) -> Option<u32> {
        (self.loading && self.read < self.length).then_some(self.read)
    }

    /// Clock edge while loading, in a cycle in which the memory takes a read or not: true if a read has to wait.
    pub fn send(&mut self, ready: bool) -> bool {
        let reads = self.read().is_some();
        self.read += u32::from(reads && ready);
        reads && !ready
    }

    /// A word comes: its number, and whether it is the last.
    pub fn take(&mut self) -> (u32, bool) {
        let number = self.come;
        self.come += 1;
        self.loading = self.come < self.length;
        (number, !self.loading)
    }
}
