//! COLOUR MEMORY: the frame memory of a machine with BLEND, which reads it too.
//!
//! ```text
//!  crd ─> rgb[addr] ─> L cycles, in order ─> cdata
//!  cwr ─> rgb[addr], the user's own [addr]
//! ```
//! Formats: addresses y·2^xb + x; words of three colours of b bits, red the most significant.
//!
//! Timing: as the depth memory's. Rules: `docs/machine.md`, section 7. Not modelled: that both may be one memory.

use crate::served::Served;
use crate::tokens::{ColorWrite, FEW, MAX_CHANNELS, OutputWords};
use crate::waits::{PageCounts, Waits};
use edgewalk_machine::Plan;

/// State of the memory.
#[derive(Clone, Debug)]
pub struct ColorMemory<const C: usize> {
    /// b.
    bits: u32,
    served: Served<u64, false>,
    rgb: Vec<u64>,
    own: Vec<[u32; MAX_CHANNELS - FEW]>,
}

/// Three colours of so many bits in one word, red the most significant.
fn packed(color: [u64; 3], bits: u32) -> u64 {
    color.into_iter().fold(0, |word, c| word << bits | c)
}

impl<const C: usize> ColorMemory<C> {
    /// A cleared memory: the colour `clear` (b bits each) everywhere, and 0 in the user's own. It stalls as often as the
    /// depth memory, but in other cycles.
    #[must_use]
    pub fn new(plan: &Plan, clear: [u64; 3], waits: impl Into<Waits>) -> Self {
        let (words, bits) = (1 << plan.widths().address, plan.color.bits);
        ColorMemory {
            bits,
            served: Served::new(plan.blend.latency, waits.into().of_another(1)),
            rgb: vec![packed(clear, bits); words],
            own: vec![[0; MAX_CHANNELS - FEW]; words],
        }
    }

    /// Fills the memory with one colour.
    pub(crate) fn clear(&mut self, color: [u64; 3]) {
        self.rgb.fill(packed(color, self.bits));
    }

    /// A read can be taken in this cycle.
    #[must_use]
    pub fn crd_ready(&self) -> bool {
        self.served.read_ready()
    }

    /// A write can be taken in this cycle.
    #[must_use]
    pub fn cwr_ready(&self) -> bool {
        self.served.write_ready()
    }

    /// The colour of the oldest read, once it is there.
    #[must_use]
    pub fn cdata(&self) -> Option<u64> {
        self.served.data()
    }

    /// What is stored at an address, with the depth that another memory has there.
    #[must_use]
    pub fn pixel(&self, addr: u32, depth: u32) -> OutputWords<C> {
        let (word, own) = (self.rgb[addr as usize], self.own[addr as usize]);
        let color = |i: usize| (word >> (self.bits * (3 - i as u32))) as u32 & ((1 << self.bits) - 1);
        std::array::from_fn(|i| match i {
            0 => depth,
            1..FEW => color(i),
            _ => own[i - FEW],
        })
    }

    /// What its pages did so far.
    #[must_use]
    pub fn pages(&self) -> PageCounts {
        self.served.pages()
    }

    /// Clock edge: the read that fired, whether the word was taken, the write that fired.
    #[inline(always)]
    pub fn step(&mut self, read: Option<u32>, taken: bool, write: Option<&ColorWrite<C>>) {
        let read = read.map(|addr| (addr, self.rgb[addr as usize]));
        self.served.step(read, taken, write.map(|write| write.addr));
        if let Some(write) = write {
            self.rgb[write.addr as usize] = write.rgb;
            self.own[write.addr as usize] =
                std::array::from_fn(|i| write.values.get(FEW + i).copied().unwrap_or(0));
        }
    }
}
