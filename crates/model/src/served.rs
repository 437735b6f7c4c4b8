//! A memory's side of a read port: reads come back in order, not before their latency.
//!
//! ```text
//!  read (address, word) ─> L clocks, and as many more as the waits ask ─> data
//! ```
//! Timing: data L cycles after the read fired, later if stalled; held until taken. Any number of reads may be on their way, or 16.
//!
//! Rules: `docs/machine.md`, section 7. Not modelled: refresh, banks.

use crate::fifo::Fifo;
use crate::waits::{Pacer, PageCounts, Waits};
use std::collections::VecDeque;

/// Reads in a queue in place: no more than a read-modify-write has on their way.
const NEAR: usize = 16;

/// Words of type `W` on their way back. Without `MANY` no more than [`NEAR`] are at a time: a cycle takes the host less time
/// then.
#[derive(Clone, Debug)]
pub(crate) struct Served<W, const MANY: bool> {
    latency: u64,
    pacer: Pacer,
    now: u64,
    /// Words read, with the cycle from which on each is offered.
    reads: Fifo<(u64, W), NEAR>,
    /// With `MANY`: words behind those, while that queue is full.
    more: VecDeque<(u64, W)>,
}

impl<W: Copy + Default, const MANY: bool> Served<W, MANY> {
    /// No read is on its way. `latency`: clocks from a read to its data.
    pub fn new(latency: u32, waits: Waits) -> Self {
        Served {
            latency: latency.into(),
            pacer: Pacer::new(waits),
            now: 0,
            reads: Fifo::default(),
            more: VecDeque::new(),
        }
    }

    /// What the memory's pages did so far.
    pub fn pages(&self) -> PageCounts {
        self.pacer.counts()
    }

    /// A read can be taken in this cycle.
    #[inline]
    pub fn read_ready(&self) -> bool {
        self.pacer.rd_ready
    }

    /// A write can be taken in this cycle.
    #[inline]
    pub fn write_ready(&self) -> bool {
        self.pacer.wr_ready
    }

    /// The word of the oldest read, once it is there.
    #[inline]
    pub fn data(&self) -> Option<W> {
        let (due, word) = *self.reads.head();
        (!self.reads.is_empty() && due <= self.now).then_some(word)
    }

    /// Clock edge: the read that fired with the word stored at its address, whether data was taken, the address of the write
    /// that fired.
    #[inline(always)]
    pub fn step(&mut self, read: Option<(u32, W)>, taken: bool, written: Option<u32>) {
        if taken {
            self.reads.pop();
            if MANY && let Some(next) = self.more.pop_front() {
                self.reads.push(next);
            }
        }
        let late = self.pacer.step(self.now, read.map(|(addr, _)| addr), written);
        if let Some((_, word)) = read {
            let read = (self.now.wrapping_add(self.latency).wrapping_add(late), word);
            if !MANY || self.reads.len() < NEAR {
                self.reads.push(read);
            } else {
                self.more.push_back(read);
            }
        }
        self.now = self.now.wrapping_add(1);
    }
}
