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
//! Rules: `docs/machine.md`, section 7. When data is late and readies are low: [`Waits`].

use crate::fifo::Fifo;
use crate::prefetch::prefetch;
use crate::tokens::{FEW, MAX_CHANNELS, OutputWords, Write};
use crate::waits::{Pacer, Waits};
use edgewalk_machine::Plan;

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
    pacer: Pacer,
    now: u64,
    /// Depths read, with the cycle from which on they are offered.
    reads: Fifo<(u64, u32), 16>,
    /// Words from a line to the next.
    pitch: usize,
    /// Depth memory by address; a read waits for this one only.
    z: Vec<u32>,
    /// Frame memory by address: a colour, 16 bits a channel, in one word, and beside it what the user's own channels hold.
    rgb: Vec<u64>,
    own: Vec<[u32; MAX_CHANNELS - FEW]>,
}

/// Red, green and blue of at most 16 bits each in one word.
#[inline]
fn pack([r, g, b]: [u32; 3]) -> u64 {
    u64::from(r) | u64::from(g) << 16 | u64::from(b) << 32
}

impl<const C: usize> Memory<C> {
    /// A cleared memory: the farthest depth and the colour `clear` (b bits each) everywhere, and 0 in the user's own.
    #[must_use]
    pub fn new(plan: &Plan, clear: [u64; 3], waits: impl Into<Waits>) -> Self {
        let words = 1 << plan.widths().address;
        Memory {
            latency: u64::from(plan.latency),
            pacer: Pacer::new(waits.into()),
            now: 0,
            reads: Fifo::default(),
            pitch: 1 << plan.widths().x,
            z: vec![plan.z.max() as u32; words],             // b <= 32 bits
            rgb: vec![pack(clear.map(|c| c as u32)); words], // b <= 16 bits
            own: vec![[0; MAX_CHANNELS - FEW]; if C > FEW { words } else { 0 }],
        }
    }

    /// A read can be taken in this cycle.
    #[inline]
    #[must_use]
    pub fn rd_ready(&self) -> bool {
        self.pacer.rd_ready
    }

    /// A write can be taken in this cycle.
    #[inline]
    #[must_use]
    pub fn wr_ready(&self) -> bool {
        self.pacer.wr_ready
    }

    /// The depth of the oldest read, once it is there.
    #[inline]
    #[must_use]
    pub fn data(&self) -> Option<u64> {
        let (due, z) = *self.reads.head();
        (!self.reads.is_empty() && due <= self.now).then_some(u64::from(z))
    }

    /// The farthest depth everywhere.
    pub fn clear_depth(&mut self, plan: &Plan) {
        self.z.fill(plan.z.max() as u32); // b <= 32 bits
    }

    /// The farthest depth of the map everywhere.
    pub(crate) fn clear_map(&mut self, plan: &Plan) {
        self.z.fill((1 << plan.shadow.depth_bits) - 1); // bz <= 24 bits
    }

    /// What is stored at an address.
    #[must_use]
    pub fn pixel(&self, addr: u32) -> OutputWords<C> {
        let at = addr as usize;
        std::array::from_fn(|i| match i {
            0 => self.z[at],
            1..FEW => u32::from((self.rgb[at] >> (16 * (i - 1))) as u16),
            _ => self.own[at][i - FEW],
        })
    }

    /// Clock edge: the read that fired, whether the data was taken, the write that fired.
    #[inline(always)]
    pub fn step(&mut self, read: Option<u32>, data_taken: bool, write: Option<&Write<C>>) {
        self.clock(read, data_taken, write.map(|write| write.addr));
        if let Some(write) = write {
            let (at, values) = (write.addr as usize, &write.values);
            self.rgb[at] = pack([values[1], values[2], values[3]]);
            if C > FEW {
                self.own[at] = std::array::from_fn(|i| values[FEW + i]);
            }
            if write.z_en {
                self.z[at] = values[0];
            }
        }
    }

    /// As [`Memory::step`] in a machine with BLEND: of a write the depth is stored, and nothing else.
    #[inline(always)]
    pub fn step_depth(&mut self, read: Option<u32>, data_taken: bool, write: Option<&Write<C>>) {
        self.clock(read, data_taken, write.map(|write| write.addr));
        if let Some(write) = write {
            self.z[write.addr as usize] = write.values[0];
        }
    }

    /// The reads, and the readies of the next cycle; a read in the cycle of a write sees the old word.
    #[inline(always)]
    fn clock(&mut self, read: Option<u32>, data_taken: bool, written: Option<u32>) {
        if data_taken {
            self.reads.pop();
        }
        let late = self.pacer.step(self.now, read, written);
        if let Some(addr) = read {
            let due = self.now.wrapping_add(self.latency).wrapping_add(late);
            self.reads.push((due, self.z[addr as usize]));
            // Triangles go down: the word below is likely to be next, and the host's own memory is slow.
            let below = (addr as usize).wrapping_add(self.pitch);
            prefetch(&self.z, below);
            prefetch(&self.rgb, below);
        }
        self.now = self.now.wrapping_add(1);
    }
}
