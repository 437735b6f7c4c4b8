//! PROJECT: where does the fragment lie in the light's view?
//!
//! ```text
//!  frag ─ x, y, z, w ─> [rows 1 .. R of 2^SB·x/w, 2^SB·y/w, 2^bz·z/w] ─ texel, depth ─> projected
//! ```
//! Formats: x, y, z, w two's complement, p + 1 bits, in the triangle's own unit; the texel SB + 1 bits, the depth bz + 2, -1
//! where there is none.
//!
//! Timing: a fragment taken in cycle n is offered to SHADOW in n + R + 1; pipelined one a clock, all stages move together;
//! serial one in R + 1 clocks.
//!
//! Rules: `docs/machine.md`, section 15. Not modelled: the rows; a fragment is divided on its way in.

mod view;

use crate::Events;
use crate::ports::{Pins, Ported, Shown};
use crate::stages::Stages;
use crate::tokens::Fragment;
use edgewalk_machine::{LIGHT_SPACE, Plan, Project as Kind};

/// What holds fragments while they are divided.
#[derive(Clone, Debug)]
enum Rows<const C: usize> {
    /// R + 1 stages.
    Pipelined(Stages<Fragment<C>>),
    /// The fragment, and how many rows are done.
    Serial { fragment: Option<Fragment<C>>, row: u32 },
}

/// State of PROJECT.
#[derive(Clone, Debug)]
pub struct Project<const C: usize> {
    /// Places of lx, ly, lz, lw among the channels.
    at: [usize; 4],
    /// p + 1.
    bits: u32,
    /// SB.
    side: u32,
    /// bz.
    depth_bits: u32,
    /// R.
    last_row: u32,
    rows: Rows<C>,
}

/// Texel and depth of a place in the light's view, as SHADOW takes them.
#[must_use]
pub fn quotients(plan: &Plan, [x, y, z, w]: [i64; 4]) -> [i64; 3] {
    let unit = Project::<8>::new(plan);
    let events = &mut Events::default();
    [unit.texel(x, w, events), unit.texel(y, w, events), unit.depth(z, w, events)]
}

impl<const C: usize> Project<C> {
    /// An empty unit.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let shadow = &plan.shadow;
        let place = |name: &str| plan.channels().iter().position(|channel| channel.name == name).unwrap_or(0);
        let rows = match shadow.project {
            Kind::Pipelined => Rows::Pipelined(Stages::new(shadow.rows() as usize + 1)),
            Kind::Serial => Rows::Serial { fragment: None, row: 0 },
        };
        Project {
            at: LIGHT_SPACE.map(place),
            bits: shadow.light_bits + 1,
            side: shadow.side_bits(),
            depth_bits: shadow.depth_bits,
            last_row: shadow.rows(),
            rows,
        }
    }

    /// Synchronous reset.
    pub fn reset(&mut self) {
        match &mut self.rows {
            Rows::Pipelined(stages) => stages.clear(),
            Rows::Serial { fragment, .. } => *fragment = None,
        }
    }

    /// A fragment is in a stage, or divided.
    #[must_use]
    pub fn occupied(&self) -> bool {
        match &self.rows {
            Rows::Pipelined(stages) => stages.held() > 0,
            Rows::Serial { fragment, .. } => fragment.is_some(),
        }
    }

    /// Serial: rows are left to be done.
    #[must_use]
    pub fn dividing(&self) -> bool {
        matches!(&self.rows, Rows::Serial { fragment: Some(_), row } if *row < self.last_row)
    }

    /// The fragment offered to SHADOW.
    #[must_use]
    pub fn projected(&self) -> Option<&Fragment<C>> {
        match &self.rows {
            Rows::Pipelined(stages) => stages.last(),
            Rows::Serial { fragment, row } => fragment.as_ref().filter(|_| *row == self.last_row),
        }
    }

    /// A fragment can be taken.
    #[must_use]
    pub fn frag_ready(&self, projected_ready: bool) -> bool {
        match &self.rows {
            Rows::Pipelined(_) => self.projected().is_none() || projected_ready,
            Rows::Serial { fragment, row } => {
                fragment.is_none() || (*row == self.last_row && projected_ready)
            }
        }
    }

    /// Clock edge. `projected_ready`: SHADOW takes what is offered to it.
    pub fn step(&mut self, frag: Option<&Fragment<C>>, projected_ready: bool, events: &mut Events) {
        let ready = self.frag_ready(projected_ready);
        let taken = frag.filter(|_| ready).map(|fragment| self.divided(fragment, events));
        match &mut self.rows {
            Rows::Pipelined(_) if !ready => events.project.project_stall += 1,
            Rows::Pipelined(stages) => stages.shift(taken),
            Rows::Serial { .. } if !ready => {
                events.project.project_wait += u64::from(frag.is_some());
                self.row();
            }
            Rows::Serial { fragment, row } => (*fragment, *row) = (taken, 0),
        }
    }

    /// A row more, if one is left.
    fn row(&mut self) {
        if self.dividing()
            && let Rows::Serial { row, .. } = &mut self.rows
        {
            *row += 1;
        }
    }

    /// The fragment with its texel and its depth in the place of what they are quotients of.
    fn divided(&self, fragment: &Fragment<C>, events: &mut Events) -> Fragment<C> {
        let [x, y, z, w] = self.at.map(|place| {
            let (word, sign) = (i64::from(fragment.values[place]), 1 << (self.bits - 1));
            (word ^ sign) - sign
        });
        let texels = [x, y].map(|x| self.texel(x, w, events));
        let depth = self.depth(z, w, events);
        events.project.behind_light += u64::from(w <= 0);
        let mut divided = *fragment;
        let cut = |value: i64, bits: u32| value as u32 & (u32::MAX >> (32 - bits)); // at most 26 bits
        divided.values[self.at[0]] = cut(texels[0], self.side + 1);
        divided.values[self.at[1]] = cut(texels[1], self.side + 1);
        divided.values[self.at[2]] = cut(depth, self.depth_bits + 2);
        divided.values[self.at[3]] = 0;
        divided
    }

    /// floor(2^SB·x/w), -1 outside the map. x has at most 28 bits, SB 12.
    fn texel(&self, x: i64, w: i64, events: &mut Events) -> i64 {
        if w <= 0 || x < 0 || x >= w {
            events.project.map_edge += u64::from(w > 0 && x == w);
            return -1;
        }
        events.project.texel_edge += u64::from((x << self.side) % w == 0);
        (x << self.side) / w
    }

    /// floor(2^bz·z/w + 1/2), -1 before the map and 2^bz behind it. z has at most 28 bits, bz 24.
    fn depth(&self, z: i64, w: i64, events: &mut Events) -> i64 {
        let end = 1 << self.depth_bits;
        if w <= 0 || z < 0 {
            -1
        } else if z >= w {
            end
        } else {
            let depth = ((z << (self.depth_bits + 1)) + w) / (2 * w);
            events.project.depth_to_end += u64::from(depth == end);
            depth
        }
    }
}

impl<const C: usize> Ported<C> for Project<C> {
    type Takes = Fragment<C>;

    fn show(&self, pins: &Pins<Self::Takes, C>, out: &mut impl Shown) {
        out.takes(self.frag_ready(pins.next));
        out.gives(self.projected());
        out.status("dividing", self.dividing());
        out.status("occupied", self.occupied());
    }

    fn clock(&mut self, pins: &Pins<Self::Takes, C>, events: &mut Events) {
        self.step(pins.token, pins.next, events);
    }

    fn clear(&mut self) {
        self.reset();
    }
}
