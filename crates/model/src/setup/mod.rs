//! SETUP: turns three vertices into first values and increments.
//!
//! ```text
//!  tri ─> sort ─┬─> 3 edges: C, R, q, f, M ───────┬─> prim
//!               └─> area, planes ─> 4 channels ───┘
//! ```
//! Formats: vertices XW bits, 2^-s px; inside, integers of any length (the lanes are as long as they need be); outside,
//! columns of COLW bits and words of b + r bits, both modular.
//!
//! Timing: a triangle taken in cycle n is computed in S1 cycles (edges, area, cull), and S2 more (channels) unless it
//! is culled; `prim` is offered from cycle n + S1 + S2 + 1 until it is taken, `tri_ready` is high in the cycle after.
//!
//! Rules: `docs/machine.md`, section 2. Not modelled: the lanes bit by bit; all is computed when the triangle arrives
//! and appears when the hardware would have it.

mod channels;
mod clocks;
mod edges;
mod sort;

pub use clocks::{SetupClocks, setup_clocks};

use crate::Coverage;
use crate::tokens::{Prim, Source};
use edgewalk_machine::{Plan, PortVertex};
use sort::Sorted;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Idle,
    Phase1,
    Phase2,
    Done,
}

/// State of SETUP.
#[derive(Clone, Debug)]
pub struct Setup {
    machine: Plan,
    clocks: SetupClocks,
    state: State,
    /// Cycles left in PHASE1 or PHASE2, less one; 0 in the others.
    left: u32,
    culled: bool,
    prim: Prim,
    /// Not hardware: triangles taken in.
    taken: u32,
}

impl Setup {
    /// An idle unit.
    #[must_use]
    pub fn new(machine: &Plan) -> Self {
        Setup {
            machine: machine.clone(),
            clocks: setup_clocks(machine),
            state: State::Idle,
            left: 0,
            culled: false,
            prim: Prim::default(),
            taken: 0,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        self.state = State::Idle;
        self.left = 0;
    }

    /// A triangle can be taken: the unit is IDLE.
    #[inline]
    #[must_use]
    pub fn tri_ready(&self) -> bool {
        self.state == State::Idle
    }

    /// The triangle offered to EDGE.
    #[inline]
    #[must_use]
    pub fn prim(&self) -> Option<&Prim> {
        (self.state == State::Done).then_some(&self.prim)
    }

    /// Clock edge.
    #[inline(always)]
    pub fn step(&mut self, tri: Option<(&[PortVertex; 3], u32)>, prim_ready: bool, coverage: &mut Coverage) {
        if self.left > 0 {
            self.left -= 1;
            return;
        }
        if self.state == State::Done && !prim_ready {
            return;
        }
        match self.state {
            State::Idle => {
                if let Some((vertices, tag)) = tri {
                    self.take(vertices, tag, coverage);
                }
            }
            State::Phase1 if self.culled => self.state = State::Idle,
            State::Phase1 => self.enter(State::Phase2, self.clocks.phase2),
            State::Phase2 => self.state = State::Done,
            State::Done => self.state = State::Idle,
        }
    }

    fn enter(&mut self, state: State, cycles: u32) {
        self.state = state;
        self.left = cycles - 1;
    }

    fn take(&mut self, vertices: &[PortVertex; 3], tag: u32, coverage: &mut Coverage) {
        let id = self.taken;
        self.taken = self.taken.wrapping_add(1);
        self.enter(State::Phase1, self.clocks.phase1);
        let sorted = Sorted::new(&self.machine, vertices);
        let prim = prepare(&self.machine, &sorted);
        self.culled = prim.is_none();
        if let Some(prim) = prim {
            self.prim = Prim { source: Source { tag, id }, ..prim };
            self.count(&sorted, coverage);
        } else {
            coverage.culled += 1;
        }
    }

    fn count(&self, sorted: &Sorted, coverage: &mut Coverage) {
        let [n1, n2] = self.prim.lines;
        let knee = sorted.corners[1].v;
        let p = 1 << self.machine.widths().center_fraction;
        coverage.major_right += u64::from(self.prim.left);
        coverage.major_left += u64::from(!self.prim.left);
        coverage.no_upper_part += u64::from(n1 == 0);
        coverage.no_lower_part += u64::from(n2 == 0);
        coverage.knee_on_line += u64::from(n1 > 0 && n2 > 0 && knee % p == 0);
    }
}

/// The increments of a triangle at the port, without tag and number; `None` if it is culled.
pub(crate) fn increments(machine: &Plan, vertices: &[PortVertex; 3]) -> Option<Prim> {
    prepare(machine, &Sorted::new(machine, vertices))
}

fn prepare(machine: &Plan, sorted: &Sorted) -> Option<Prim> {
    let area = sorted.area();
    let parts = edges::parts(machine, sorted);
    if area == 0 || parts.lines == [0, 0] {
        return None;
    }
    let [a, b, c] = &sorted.corners;
    let major = edges::walk(machine, a, c, parts.drawn());
    let minor = [edges::walk(machine, a, b, parts.first[0]), edges::walk(machine, b, c, parts.first[1])];
    let mut prim = Prim {
        line: parts.drawn() as u32, // first drawn line, 0 <= jm < H
        lines: parts.lines,
        left: area < 0,
        major,
        minor,
        ..Prim::default()
    };
    channels::prepare(machine, sorted, &parts, &mut prim);
    Some(prim)
}

/// floor(n/d + 1/2), d > 0: RN.
fn round_div(n: i128, d: i128) -> i128 {
    (n + d / 2).div_euclid(d)
}
