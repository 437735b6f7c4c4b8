//! One read-modify-write of a memory: the words that are on their way, and what happens if a pixel comes again meanwhile.
//!
//! ```text
//!  addr, side ─┬─> read              data ──┐
//!              └─> in-flight queue ─> head ─┴─> old ··(the unit)··> new ─> w ─> write
//!                     ^── forward ─────────────────────────────────────────┘
//! ```
//! `T` is the word of the memory, `S` what travels beside it. The unit that works on the words counts the events and says
//! what becomes of the old word; DEPTH and BLEND are such units.
//!
//! Timing: an access and a result a clock; a result of cycle n is offered as a write in n + 1.
//!
//! Rules: `docs/machine.md`, sections 6 and 9. Not modelled: nothing.

mod view;

use edgewalk_machine::Hazard;

/// Places; a machine's queues are at most as deep.
const PLACES: usize = 16;

/// Why no access can enter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// The fragment's pixel may still be in flight.
    Hazard,
    /// The in-flight queue is full.
    Full,
}

/// An access that has its word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Retired<T> {
    pub addr: u32,
    /// Place of its side, [`Rmw::side`], which stands there until another access enters.
    slot: usize,
    /// The word before this access.
    pub old: T,
    /// The value comes from an older access, not from the memory.
    pub forwarded: bool,
}

/// The write register.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Outcome<T, S> {
    pub addr: u32,
    pub side: S,
    /// The new word.
    pub word: T,
    /// The value is stored; the data beside it are stored in any case.
    pub stored: bool,
}

/// State of a read-modify-write.
///
/// The queue is columns instead of records: fields are then read as they were written, one by one. A record written field
/// by field and copied whole in the next cycle would make the host wait until its stores are done.
#[derive(Clone, Debug)]
pub(crate) struct Rmw<T, S> {
    hazard: Hazard,
    /// The hazard policy is forward.
    forwards: bool,
    depth: usize,
    head: usize,
    len: usize,
    addr: [u32; PLACES],
    side: [S; PLACES],
    /// The old word comes from an older access: `fwd_valid` and `fwd_z`.
    forwarded: [bool; PLACES],
    forward: [T; PLACES],
    w_valid: bool,
    w: Outcome<T, S>,
}

impl<T: Copy + Default, S: Copy + Default> Rmw<T, S> {
    /// An empty one; `depth`: places of its queue, at most 16.
    pub(crate) fn new(hazard: Hazard, depth: u32) -> Self {
        Rmw {
            hazard,
            forwards: hazard == Hazard::Forward,
            depth: depth as usize,
            head: 0,
            len: 0,
            addr: [0; PLACES],
            side: [S::default(); PLACES],
            forwarded: [false; PLACES],
            forward: [T::default(); PLACES],
            w_valid: false,
            w: Outcome::default(),
        }
    }

    /// Synchronous reset.
    pub(crate) fn reset(&mut self) {
        self.len = 0;
        self.w_valid = false;
    }

    /// The hazard policy.
    pub(crate) fn policy(&self) -> Hazard {
        self.hazard
    }

    /// Accesses or a write are in flight.
    #[inline]
    pub(crate) fn occupied(&self) -> bool {
        self.len > 0 || self.w_valid
    }

    /// Accesses between read and compare.
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// What keeps an access, its address and fence, from being read. Without one there is no hazard. `writes`: results may
    /// be stored.
    #[inline]
    pub(crate) fn block(&self, access: Option<(u32, bool)>, writes: bool) -> Option<Block> {
        if access.is_some_and(|(addr, fence)| self.must_wait(addr, fence, writes)) {
            Some(Block::Hazard)
        } else {
            (self.len == self.depth).then_some(Block::Full)
        }
    }

    #[inline]
    fn must_wait(&self, addr: u32, fence: bool, writes: bool) -> bool {
        match self.hazard {
            Hazard::Forward => false,
            Hazard::Drain => fence && self.occupied(),
            Hazard::Interlock => writes && (self.holds(addr) || self.w_stores(addr)),
        }
    }

    /// An access of this address is queued.
    #[inline]
    fn holds(&self, addr: u32) -> bool {
        self.slots().any(|slot| self.addr[slot] == addr)
    }

    /// w is about to store a word there.
    #[inline]
    fn w_stores(&self, addr: u32) -> bool {
        self.w_valid && self.w.stored && self.w.addr == addr
    }

    /// The oldest access, its address and side.
    #[inline]
    pub(crate) fn head(&self) -> Option<(u32, &S)> {
        let slot = self.slot(0);
        (self.len > 0).then_some((self.addr[slot], &self.side[slot]))
    }

    /// All accesses that are queued, the oldest first.
    pub(crate) fn queued(&self) -> impl Iterator<Item = (u32, &S)> {
        self.slots().map(|slot| (self.addr[slot], &self.side[slot]))
    }

    /// The old word can be taken.
    #[inline]
    pub(crate) fn data_ready(&self, wr_ready: bool) -> bool {
        self.len > 0 && (!self.w_valid || wr_ready)
    }

    /// The write offered to the memory.
    #[inline]
    pub(crate) fn write(&self) -> Option<&Outcome<T, S>> {
        self.w_valid.then_some(&self.w)
    }

    /// Slots of the queue, the oldest first. One after the other: places asked all at once would be read as one word of the host,
    /// which waits until the word of the cycle before is written.
    #[inline]
    fn slots(&self) -> impl Iterator<Item = usize> + use<T, S> {
        let head = self.head;
        (0..self.len).map(move |place| head.wrapping_add(place) & (PLACES - 1))
    }

    #[inline]
    fn slot(&self, place: usize) -> usize {
        self.head.wrapping_add(place) & (PLACES - 1)
    }

    /// The side of the youngest access; a stale one if there is none.
    pub(crate) fn youngest(&self) -> &S {
        &self.side[self.slot(self.len.wrapping_sub(1))]
    }

    /// Queues an access that is not blocked; true: w stores a word there, and it takes that one.
    #[inline]
    pub(crate) fn enter(&mut self, addr: u32, side: S) -> bool {
        let slot = self.slot(self.len);
        let written = self.forwards && self.w_stores(addr);
        self.addr[slot] = addr;
        self.side[slot] = side;
        self.forwarded[slot] = written;
        self.forward[slot] = self.w.word;
        self.len = self.len.wrapping_add(1);
        written
    }

    /// Drops the oldest access and gives it its old word; `data` is what the memory says.
    #[inline]
    pub(crate) fn retire(&mut self, data: T) -> Retired<T> {
        let slot = self.slot(0);
        let forwarded = self.forwarded[slot];
        let old = if forwarded { self.forward[slot] } else { data };
        let retired = Retired { addr: self.addr[slot], slot, old, forwarded };
        self.head = self.slot(1);
        self.len = self.len.wrapping_sub(1);
        retired
    }

    /// What travels beside an access just retired.
    #[inline]
    pub(crate) fn side(&self, of: &Retired<T>) -> &S {
        &self.side[of.slot]
    }

    /// Loads w with a new word for the access just retired, its side as it is. Nobody looks at w where it is not `valid`; so
    /// it is loaded without asking, as a register would be. Gives the number of accesses in flight that take its word: those
    /// queued, the one that entered in this same cycle among them.
    #[inline]
    pub(crate) fn finish(&mut self, valid: bool, of: &Retired<T>, word: T, stored: bool) -> u64 {
        self.w_valid = valid;
        // From its place in the queue straight to w: a copy on the way is one that the host has to wait for.
        self.w = Outcome { addr: of.addr, side: self.side[of.slot], word, stored };
        self.forward_w()
    }

    /// As [`Self::finish`], with a side that changed since the access retired.
    #[inline]
    pub(crate) fn finish_with(&mut self, result: Outcome<T, S>) -> u64 {
        self.w_valid = true;
        self.w = result;
        self.forward_w()
    }

    /// No access retires: w is empty once its write is taken.
    #[inline]
    pub(crate) fn no_result(&mut self, wr_ready: bool) {
        self.w_valid &= !wr_ready;
    }

    #[inline]
    fn forward_w(&mut self) -> u64 {
        if self.forwards && self.w_valid && self.w.stored && self.holds(self.w.addr) {
            self.forward_to_queue(self.w.addr, self.w.word)
        } else {
            0
        }
    }

    fn forward_to_queue(&mut self, addr: u32, word: T) -> u64 {
        let mut taken = 0;
        for slot in self.slots() {
            if self.addr[slot] == addr {
                self.forwarded[slot] = true;
                self.forward[slot] = word;
                taken += 1;
            }
        }
        taken
    }
}
