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

use crate::prefetch::prefetch;
use crate::served::Served;
use crate::tokens::{FEW, MAX_CHANNELS, OutputWords, Write};
use crate::waits::{PageCounts, Waits};
use edgewalk_machine::Plan;

/// State of the memory.
#[derive(Clone, Debug)]
pub struct Memory<const C: usize> {
    served: Served<u32, false>,
    /// Words from a line to the next.
    pitch: usize,
    /// Depth and frame memory by address, side by side, as the host's own memory is slow: depth, and the low LOW bits of red,
    /// green and blue. By exclusive or with those of a cleared pixel: zeros are what the host gives a new memory without filling it.
    pixels: Vec<[u32; 2]>,
    clear: [u32; 2],
    /// Bits of colours beyond, if there are any.
    high: Vec<u32>,
    /// What the user's own channels hold.
    own: Vec<[u32; MAX_CHANNELS - FEW]>,
}

/// So many bits of each colour stand beside the depth.
const LOW: u32 = 10;

/// The low LOW bits of red, green and blue.
#[inline]
fn pack([r, g, b]: [u32; 3]) -> u32 {
    let low = (1 << LOW) - 1;
    r & low | (g & low) << LOW | (b & low) << (2 * LOW)
}

impl<const C: usize> Memory<C> {
    /// A cleared memory: the farthest depth and the colour `clear` (b bits each) everywhere, and 0 in the user's own.
    #[must_use]
    pub fn new(plan: &Plan, clear: [u64; 3], waits: impl Into<Waits>) -> Self {
        let words = 1 << plan.widths().address;
        let clear = clear.map(|c| c as u32); // b <= 16 bits
        let high = if plan.color.bits > LOW { words } else { 0 };
        Memory {
            served: Served::new(plan.latency, waits.into()),
            pitch: 1 << plan.widths().x,
            pixels: vec![[0; 2]; words],
            clear: [plan.z.max() as u32, pack(clear)], // b <= 32 bits
            high: vec![pack(clear.map(|c| c >> LOW)); high],
            own: vec![[0; MAX_CHANNELS - FEW]; if C > FEW { words } else { 0 }],
        }
    }

    /// A read can be taken in this cycle.
    #[inline]
    #[must_use]
    pub fn rd_ready(&self) -> bool {
        self.served.read_ready()
    }

    /// A write can be taken in this cycle.
    #[inline]
    #[must_use]
    pub fn wr_ready(&self) -> bool {
        self.served.write_ready()
    }

    /// The depth of the oldest read, once it is there.
    #[inline]
    #[must_use]
    pub fn data(&self) -> Option<u64> {
        self.served.data().map(u64::from)
    }

    /// Tells that two columns of a line, px on the screen or beside it, will soon be asked for. Not hardware: it changes nothing but
    /// the host's time.
    #[inline(always)]
    pub fn expect(&self, line: u32, columns: [i32; 2]) {
        let start = (line as usize).wrapping_mul(self.pitch);
        for column in columns {
            prefetch(&self.pixels, start.wrapping_add_signed(column as isize));
        }
    }

    /// The farthest depth everywhere.
    pub fn clear_depth(&mut self, plan: &Plan) {
        self.fill_depth(plan.z.max() as u32); // b <= 32 bits
    }

    /// The farthest depth of the map everywhere.
    pub(crate) fn clear_map(&mut self, plan: &Plan) {
        self.fill_depth((1 << plan.shadow.depth_bits) - 1); // bz <= 24 bits
    }

    fn fill_depth(&mut self, depth: u32) {
        let stored = depth ^ self.clear[0];
        self.pixels.iter_mut().for_each(|[z, _]| *z = stored);
    }

    /// What is stored at an address.
    #[must_use]
    pub fn pixel(&self, addr: u32) -> OutputWords<C> {
        let at = addr as usize;
        let [z, low]: [u32; 2] = std::array::from_fn(|i| self.pixels[at][i] ^ self.clear[i]);
        let high = self.high.get(at).copied().unwrap_or(0);
        let color = |word: u32, i: usize| word >> (LOW * (i as u32 - 1)) & ((1 << LOW) - 1);
        std::array::from_fn(|i| match i {
            0 => z,
            1..FEW => color(high, i) << LOW | color(low, i),
            _ => self.own[at][i - FEW],
        })
    }

    /// What its pages did so far.
    #[must_use]
    pub fn pages(&self) -> PageCounts {
        self.served.pages()
    }

    /// Clock edge: the read that fired, whether the data was taken, the write that fired.
    #[inline(always)]
    pub fn step(&mut self, read: Option<u32>, data_taken: bool, write: Option<&Write<C>>) {
        self.clock(read, data_taken, write.map(|write| write.addr));
        if let Some(write) = write {
            let (at, values) = (write.addr as usize, &write.values);
            let color = [values[1], values[2], values[3]];
            self.pixels[at][1] = pack(color) ^ self.clear[1];
            if let Some(high) = self.high.get_mut(at) {
                *high = pack(color.map(|c| c >> LOW));
            }
            if C > FEW {
                self.own[at] = std::array::from_fn(|i| values[FEW + i]);
            }
            if write.z_en {
                self.pixels[at][0] = values[0] ^ self.clear[0];
            }
        }
    }

    /// As [`Memory::step`] in a machine with BLEND: of a write the depth is stored, and nothing else.
    #[inline(always)]
    pub fn step_depth(&mut self, read: Option<u32>, data_taken: bool, write: Option<&Write<C>>) {
        self.clock(read, data_taken, write.map(|write| write.addr));
        if let Some(write) = write {
            self.pixels[write.addr as usize][0] = write.values[0] ^ self.clear[0];
        }
    }

    /// The reads, and the readies of the next cycle; a read in the cycle of a write sees the old word.
    #[inline(always)]
    fn clock(&mut self, read: Option<u32>, data_taken: bool, written: Option<u32>) {
        let read = read.map(|addr| (addr, self.pixels[addr as usize][0] ^ self.clear[0]));
        self.served.step(read, data_taken, written);
    }
}
