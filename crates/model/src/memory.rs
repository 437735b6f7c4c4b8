//! MEMORY: depth and frame memory behind the machine's ports, and the stalls it may show.
//!
//! ```text
//!  rd ─> depth[addr] ─> L cycles, in order ─> data
//!  wr ─> depth[addr] if z_en, colour[addr]
//! ```
//! Formats: addresses y·2^xb + x; depth and colour of b bits.
//!
//! Timing: data L cycles after the read fired, later if stalled; held until taken. A read that fires together with a
//! write sees the old word. One read and one write a clock.
//!
//! Rules: `docs/machine.md`, section 7. Not modelled: refresh, banks, anything but late data and low readies.

use crate::fifo::Fifo;
use crate::tokens::{Rgb, Write};
use edgewalk_numerics::Machine;
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
pub struct Memory {
    latency: u64,
    stalls: Stalls,
    random: Pcg32,
    now: u64,
    rd_ready: bool,
    wr_ready: bool,
    /// Depths read, with the cycle from which on they are offered.
    reads: Fifo<(u64, u32), 16>,
    words: Vec<Stored>,
}

/// A pixel of both memories.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stored {
    /// Depth, b <= 32 bits.
    pub z: u32,
    /// Colour, b <= 16 bits a channel.
    pub rgb: Rgb,
}

impl Memory {
    /// A cleared memory: the farthest depth, and the colour `clear` (b bits each) everywhere.
    #[must_use]
    pub fn new(machine: &Machine, clear: [u64; 3], stalls: Stalls) -> Self {
        let empty = Stored { z: machine.z.max() as u32, rgb: Rgb::new(clear.map(|c| c as u16)) };
        let mut memory = Memory {
            latency: u64::from(machine.latency),
            stalls,
            random: Pcg32::seed_from_u64(stalls.seed),
            now: 0,
            rd_ready: true,
            wr_ready: true,
            reads: Fifo::default(),
            words: vec![empty; 1 << machine.widths().address],
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

    /// Depth and colour stored at an address.
    #[must_use]
    pub fn pixel(&self, addr: u32) -> Stored {
        self.words[addr as usize]
    }

    /// Clock edge: the read that fired, whether the data was taken, the write that fired.
    #[inline]
    pub fn step(&mut self, read: Option<u32>, data_taken: bool, write: Option<&Write>) {
        if data_taken {
            self.reads.pop();
        }
        if let Some(addr) = read {
            let due = self.now + self.latency + self.late();
            self.reads.push((due, self.words[addr as usize].z));
        }
        if let Some(write) = write {
            let word = &mut self.words[write.addr as usize];
            word.rgb = write.rgb;
            if write.z_en {
                word.z = write.z;
            }
        }
        self.now += 1;
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
        if self.stalls.rd | self.stalls.wr != 0 {
            let [rd, wr, ..] = self.random.next_u32().to_le_bytes();
            self.rd_ready = rd >= self.stalls.rd;
            self.wr_ready = wr >= self.stalls.wr;
        }
    }
}
