//! The pages of a dynamic memory, and the lines of its controller: one that holds what was read last, and one that gathers writes.
//!
//! ```text
//!  read ──> in the line that was read last? a clock
//!       └─> the gathered words of its line, turn, page, a line of words, the one asked for first
//!  write ─> in the line that gathers? a clock
//!       └─> the words gathered before: turn, page, `word` clocks each; then a clock
//! ```
//! With `line=1` the controller has no lines. What is gathered at the end of a frame is not written.

/// A dynamic memory behind one controller: a word of it holds depth and colour of a pixel, an open page answers at once.
/// While it works on something neither port is ready.
///
/// It is made from its description alone, which is checked: a memory that refreshes without end, or has no page, is an
/// error there.
/// ```
/// use edgewalk_model::Waits;
/// assert!("dram:refresh=780,busy=13".parse::<Waits>().is_ok());
/// let error = "dram:refresh=13,busy=13".parse::<Waits>().map_err(|error| error.to_string());
/// assert_eq!(error, Err("dram: refresh = 13 is not permitted with busy = 13 (0, or more than busy)".to_owned()));
/// ```
/// ```compile_fail,E0451
/// use edgewalk_model::{Dram, Waits};
/// let endless = Dram { banks: 4, page: 256, miss: 6, turn: 2, refresh: 13, busy: 13, word: 1, line: 1 };
/// let waits = Waits::Dram(endless);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dram {
    /// Banks, each with one page open; page p lies in bank p mod `banks`.
    pub(super) banks: u32,
    /// Words of a page.
    pub(super) page: u32,
    /// Clocks to close a page and open another.
    pub(super) miss: u32,
    /// Clocks to turn from reads to writes or back.
    pub(super) turn: u32,
    /// Clocks from refresh to refresh, which closes all pages, more than `busy`; 0: none.
    pub(super) refresh: u32,
    /// Clocks that a refresh takes.
    pub(super) busy: u32,
    /// Clocks that the word of an access takes.
    pub(super) word: u32,
    /// Words of a line that reads bring as a burst, and in which writes are gathered; 1: no lines.
    pub(super) line: u32,
}

/// What the pages of a dynamic memory did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PageCounts {
    /// Accesses to an open page.
    pub hits: u64,
    /// Accesses for which a page was opened.
    pub misses: u64,
    /// Turns from reads to writes or back.
    pub turns: u64,
    /// Refreshes.
    pub refreshes: u64,
    /// Accesses to words that a line of the controller holds; they are no hits.
    pub in_line: u64,
}

impl PageCounts {
    /// Adds the counts of a later part of the run.
    #[must_use]
    pub fn and(self, after: PageCounts) -> PageCounts {
        PageCounts {
            hits: self.hits + after.hits,
            misses: self.misses + after.misses,
            turns: self.turns + after.turns,
            refreshes: self.refreshes + after.refreshes,
            in_line: self.in_line + after.in_line,
        }
    }

    /// What came after `before`.
    #[must_use]
    pub fn since(self, before: PageCounts) -> PageCounts {
        PageCounts {
            hits: self.hits - before.hits,
            misses: self.misses - before.misses,
            turns: self.turns - before.turns,
            refreshes: self.refreshes - before.refreshes,
            in_line: self.in_line - before.in_line,
        }
    }
}

/// State of a dynamic memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Pages {
    /// The page open in each bank.
    open: Vec<Option<u32>>,
    /// The last access was a write.
    writing: bool,
    /// The cycle of the next refresh.
    pub refresh: u64,
    /// What happened so far.
    pub counts: PageCounts,
    /// The line that was read last.
    read: Option<u32>,
    /// The line that gathers writes, and a bit for each of its words that waits.
    gathered: Option<(u32, u64)>,
}

impl Pages {
    /// All pages closed.
    pub fn new(dram: &Dram) -> Pages {
        Pages { open: vec![None; dram.banks as usize], refresh: dram.refresh.into(), ..Pages::default() }
    }

    /// A refresh closes all pages.
    pub fn close(&mut self, dram: &Dram) {
        self.open.fill(None);
        self.refresh += u64::from(dram.refresh);
        self.counts.refreshes += 1;
    }

    /// Clocks until the word is there, and until the controller is free.
    pub fn read(&mut self, dram: &Dram, addr: u32) -> [u64; 2] {
        let line = addr / dram.line;
        if dram.line > 1 && self.read == Some(line) {
            self.counts.in_line += 1;
            return [1; 2];
        }
        let before =
            if self.gathered.is_some_and(|(gathered, _)| gathered == line) { self.flush(dram) } else { 0 };
        self.read = Some(line);
        let there = before + self.access(dram, addr, false);
        [there, there + u64::from(dram.word) * u64::from(dram.line - 1)]
    }

    /// Clocks until the controller is free.
    pub fn write(&mut self, dram: &Dram, addr: u32) -> u64 {
        if dram.line == 1 {
            return self.access(dram, addr, true);
        }
        let (line, word) = (addr / dram.line, 1 << (addr % dram.line));
        match &mut self.gathered {
            Some((gathered, words)) if *gathered == line => {
                *words |= word;
                self.counts.in_line += 1;
                1
            }
            _ => {
                let before = self.flush(dram);
                self.gathered = Some((line, word));
                before + 1
            }
        }
    }

    /// Writes the gathered line to memory, and gives the clocks of the burst.
    fn flush(&mut self, dram: &Dram) -> u64 {
        let Some((line, words)) = self.gathered.take() else { return 0 };
        let first = self.access(dram, line * dram.line, true);
        first + u64::from(dram.word) * u64::from(words.count_ones() - 1)
    }

    /// Clocks until the first word of an access is there, or written.
    fn access(&mut self, dram: &Dram, addr: u32, writes: bool) -> u64 {
        let mut clocks = u64::from(dram.word);
        if self.writing != writes {
            clocks += u64::from(dram.turn);
            self.counts.turns += 1;
        }
        self.writing = writes;
        let page = addr / dram.page;
        let open = &mut self.open[(page % dram.banks) as usize];
        if *open == Some(page) {
            self.counts.hits += 1;
        } else {
            clocks += u64::from(dram.miss);
            self.counts.misses += 1;
        }
        *open = Some(page);
        clocks
    }
}
