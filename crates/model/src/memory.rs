//! MEMORY: depth and frame memory behind the machine's ports, and the stalls it may show.
//!
//! ```text
//!  rd ─> depth[addr] ─> L cycles, in order ─> data
//!  wr ─> depth[addr] if z_en, colour and the user's own [addr]
//! ```
//! Formats: addresses y·2^xb + x; values of b bits.
//!
//! Timing: data L cycles after the read fired, later if stalled; held until taken. A read that fires together with a
//! write sees the old word. One read and one write a clock.
//!
//! Rules: `docs/machine.md`, section 7. Not modelled: refresh, banks, anything but late data and low readies.

use crate::fifo::Fifo;
use crate::prefetch::prefetch;
use crate::tokens::{OutputWords, Write};
use edgewalk_machine::Plan;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::{RngCore, SeedableRng};

/// How often the memory makes the machine wait, in 256ths; all zero: never. The same seed stalls in the same cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stalls {
    /// Seed of the pattern.
    pub seed: u64,
    /// `rd_ready` is low in so many of 256 cycles.
    pub rd: u8,
    /// So many of 256 reads take 1 to 8 cycles longer.
    pub data: u8,
    /// `wr_ready` is low in so many of 256 cycles.
    pub wr: u8,
}

impl Stalls {
    /// A memory that is always ready.
    pub const NONE: Stalls = Stalls { seed: 0, rd: 0, data: 0, wr: 0 };
}

/// State of the memory.
#[derive(Clone, Debug)]
pub struct Memory<const C: usize> {
    latency: u64,
    stalls: Stalls,
    /// Any readies to draw.
    readies_vary: bool,
    random: Pcg32,
    now: u64,
    rd_ready: bool,
    wr_ready: bool,
    /// Depths read, with the cycle from which on they are offered.
    reads: Fifo<(u64, u32), 16>,
    /// Words from a line to the next.
    pitch: usize,
    /// Depth and frame memory by address, side by side as the channels stand.
    pixels: Vec<OutputWords<C>>,
}

impl<const C: usize> Memory<C> {
    /// A cleared memory: the farthest depth and the colour `clear` (b bits each) everywhere, and 0 in the user's own.
    #[must_use]
    pub fn new(plan: &Plan, clear: [u64; 3], stalls: Stalls) -> Self {
        let words = 1 << plan.widths().address;
        let [r, g, b] = clear.map(|c| c as u32); // b <= 16 bits
        let empty = std::array::from_fn(|i| [plan.z.max() as u32, r, g, b].get(i).copied().unwrap_or(0));
        let mut memory = Memory {
            latency: u64::from(plan.latency),
            stalls,
            readies_vary: stalls.rd | stalls.wr != 0,
            random: Pcg32::seed_from_u64(stalls.seed),
            now: 0,
            rd_ready: true,
            wr_ready: true,
            reads: Fifo::default(),
            pitch: 1 << plan.widths().x,
            pixels: vec![empty; words],
        };
        memory.draw_readies();
        memory
    }

    /// A read can be taken in this cycle.
    #[inline]
    #[must_use]
    pub fn rd_ready(&self) -> bool {
        self.rd_ready
    }

    /// A write can be taken in this cycle.
    #[inline]
    #[must_use]
    pub fn wr_ready(&self) -> bool {
        self.wr_ready
    }

    /// The depth of the oldest read, once it is there.
    #[inline]
    #[must_use]
    pub fn data(&self) -> Option<u64> {
        let (due, z) = *self.reads.head();
        (!self.reads.is_empty() && due <= self.now).then_some(u64::from(z))
    }

    /// What is stored at an address.
    #[must_use]
    pub fn pixel(&self, addr: u32) -> OutputWords<C> {
        self.pixels[addr as usize]
    }

    /// Clock edge: the read that fired, whether the data was taken, the write that fired.
    #[inline(always)]
    pub fn step(&mut self, read: Option<u32>, data_taken: bool, write: Option<&Write<C>>) {
        if data_taken {
            self.reads.pop();
        }
        if let Some(addr) = read {
            let due = self.now.wrapping_add(self.latency).wrapping_add(self.late());
            self.reads.push((due, self.pixels[addr as usize][0]));
            // Triangles go down: the word below is likely to be next, and the host's own memory is slow.
            let below = (addr as usize).wrapping_add(self.pitch);
            prefetch(&self.pixels, below);
        }
        if let Some(write) = write {
            let pixel = &mut self.pixels[write.addr as usize];
            let z = if write.z_en { write.values[0] } else { pixel[0] };
            *pixel = write.values;
            pixel[0] = z;
        }
        self.now = self.now.wrapping_add(1);
        self.draw_readies();
    }

    fn late(&mut self) -> u64 {
        if self.stalls.data == 0 {
            return 0;
        }
        let [chance, cycles, ..] = self.random.next_u32().to_le_bytes();
        if chance < self.stalls.data { 1 + u64::from(cycles % 8) } else { 0 }
    }

    #[inline]
    fn draw_readies(&mut self) {
        if self.readies_vary {
            let [rd, wr, ..] = self.random.next_u32().to_le_bytes();
            self.rd_ready = rd >= self.stalls.rd;
            self.wr_ready = wr >= self.stalls.wr;
        }
    }
}
