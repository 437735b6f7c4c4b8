//! The fast path: the picture and the clock of the machine, without ticking.
//!
//! ```text
//!  tri ─> setup ─> walk the lines ─┬─> span: pixels, LANES at a time ─> picture
//!                                  └─> clock: max-plus over spans ────> counters
//! ```
//! Written from `docs/machine.md`. What comes out is what [`render`](crate::render) gives with a memory that never
//! stalls, bit by bit and cycle by cycle; a frame where that cannot be said in advance is ticked, and says so ([`Path`]).
//!
//! Not modelled: the corner counters ([`Coverage`](crate::Coverage)), memories that stall.

mod divide;
mod setup;
mod prefetch;
mod walk;
mod inflight;
mod clock;
mod pixel;
mod picture;
mod span;
mod frame;
mod vector;

use crate::counters::Counters;
use crate::memory::Stalls;
use crate::run::{DrawState, render};
use edgewalk_numerics::{Machine, PortVertex};
use picture::Picture;
use pixel::Pixel;

/// Why a frame was ticked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The in-flight queue is so short that it fills: `fifo.inflight` <= `memory.latency` / T.
    Queue,
    /// Interlock, and a fragment may have met its own address in flight.
    Interlock,
}

/// How a frame was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// Without ticking.
    Fast,
    /// Cycle by cycle.
    Ticked(Reason),
}

/// Colours packed into as few bits as they need.
#[derive(Clone, Debug)]
enum Memory {
    Narrow(Picture<u64>),
    Wide(Picture<u128>),
}

/// Draws frame after frame into the same memory.
#[derive(Clone, Debug)]
pub struct Renderer {
    machine: Machine,
    details: bool,
    memory: Memory,
    counters: Counters,
    path: Path,
}

impl Renderer {
    /// A renderer with nothing drawn; the machine must have passed [`Machine::check`]. `details`: keep coverage, writes
    /// and ids of every pixel.
    #[must_use]
    pub fn new(machine: &Machine, details: bool) -> Self {
        let memory = if machine.color.bits <= 8 {
            Memory::Narrow(Picture::default())
        } else {
            Memory::Wide(Picture::default())
        };
        let mut renderer = Renderer {
            machine: machine.clone(),
            details,
            memory,
            counters: Counters::default(),
            path: Path::Fast,
        };
        renderer.draw([], DrawState::default());
        renderer
    }

    /// Clears the picture and draws the triangles in order.
    pub fn draw<I>(&mut self, triangles: I, state: DrawState)
    where
        I: IntoIterator<Item = [PortVertex; 3]>,
        I::IntoIter: Clone,
    {
        let triangles = triangles.into_iter();
        let drawn = match &mut self.memory {
            Memory::Narrow(picture) => draw_into(&self.machine, triangles, &state, self.details, picture),
            Memory::Wide(picture) => draw_into(&self.machine, triangles, &state, self.details, picture),
        };
        (self.counters, self.path) = drawn;
    }

    /// Performance counters of the frame.
    #[must_use]
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// How the frame was drawn.
    #[must_use]
    pub fn path(&self) -> Path {
        self.path
    }

    fn pixels(&self) -> usize {
        self.machine.width as usize * self.machine.height as usize
    }

    /// Stored depth and colour of a pixel, b bits each; `None` off the screen.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<(u64, [u64; 3])> {
        let place = y as usize * self.machine.width as usize + x as usize;
        if x >= self.machine.width || y >= self.machine.height {
            return None;
        }
        match &self.memory {
            Memory::Narrow(picture) => picture.pixels.get(place).map(|p| (u64::from(p.depth()), p.rgb())),
            Memory::Wide(picture) => picture.pixels.get(place).map(|p| (u64::from(p.depth()), p.rgb())),
        }
    }

    /// Fragments, writes, and the number of the triangle that wrote last (-1: none) of every pixel; empty without
    /// details.
    #[must_use]
    pub fn details(&self) -> (&[u32], &[u32], &[i32]) {
        let details = match &self.memory {
            Memory::Narrow(picture) => &picture.details,
            Memory::Wide(picture) => &picture.details,
        };
        let pixels = if self.details { self.pixels() } else { 0 };
        (&details.coverage[..pixels], &details.writes[..pixels], &details.id[..pixels])
    }
}

/// Draws the triangles in order; the machine must have passed [`Machine::check`].
pub fn draw<I>(machine: &Machine, triangles: I, state: DrawState) -> Renderer
where
    I: IntoIterator<Item = [PortVertex; 3]>,
    I::IntoIter: Clone,
{
    let mut renderer = Renderer::new(machine, true);
    renderer.draw(triangles, state);
    renderer
}

/// The queue holds at most a fragment every T clocks for L clocks; it never fills if it has room for one more.
fn queue_fills(machine: &Machine) -> bool {
    machine.inflight <= machine.latency / machine.clocks_per_pixel()
}

fn draw_into<P: Pixel>(
    machine: &Machine,
    triangles: impl Iterator<Item = [PortVertex; 3]> + Clone,
    state: &DrawState,
    details: bool,
    picture: &mut Picture<P>,
) -> (Counters, Path) {
    let drawn = if queue_fills(machine) {
        Err(Reason::Queue)
    } else {
        picture.clear(machine, state, details);
        if details {
            vector::draw::<P, true>(machine, triangles.clone(), state, picture)
        } else {
            vector::draw::<P, false>(machine, triangles.clone(), state, picture)
        }
    };
    match drawn {
        Ok(counters) => (counters, Path::Fast),
        Err(reason) => {
            let frame = render(machine, triangles, *state, Stalls::NONE);
            let counters = frame.counters.clone();
            picture.copy(machine, frame);
            (counters, Path::Ticked(reason))
        }
    }
}
