//! Bilinear colours along an edge: the value on its first line, and the step to the next.

use super::table::Colours;
use crate::tokens::Prim;
use edgewalk_machine::{COLOURS, Plan};

/// The formats of colours, and how long those of an edge take.
#[derive(Clone, Debug)]
pub(super) struct Along {
    /// log2 P.
    t: u32,
    /// r - e.
    up: u32,
    /// 2^(r-1), 0 if r = 0: the output is rounded.
    half: i128,
    /// 2^(b+r) - 1.
    mask: u64,
    /// Q.
    pub clocks: u32,
}

impl Along {
    pub fn new(plan: &Plan) -> Along {
        let (w, colour) = (plan.widths(), plan.channels()[COLOURS.start]);
        let (t, up) = (w.center_fraction, colour.fraction - colour.vertex_fraction);
        Along {
            t,
            up,
            half: 1 << colour.fraction >> 1,
            mask: (1 << colour.word()) - 1,
            clocks: colour.vertex_bits() + w.difference - 1 + 2 * up + t + 6,
        }
    }

    /// Of the edge of a side that has lines.
    pub fn colours<const C: usize>(&self, prim: &Prim<C>, side: usize) -> Colours {
        let [upper, lower] = [[0, 2], [0, 1], [1, 2]][side];
        let height = i128::from(prim.heights[side]);
        let down = i128::from(prim.down[upper]);
        let mut colours = Colours::default();
        for (colour, at) in prim.colours.iter().enumerate() {
            let [from, to] = [upper, lower].map(|vertex| i128::from(at[vertex]));
            let first = nearest(((to - from) * down) << self.up, height);
            colours.values[colour] = (first + (from << self.up) + self.half) as u64 & self.mask;
            colours.steps[colour] = nearest((to - from) << (self.t + self.up), height) as u64 & self.mask;
        }
        colours
    }

    /// A value a line further.
    pub fn step(&self, colours: &Colours) -> Colours {
        let values = [0, 1, 2].map(|colour| (colours.values[colour] + colours.steps[colour]) & self.mask);
        Colours { values, ..*colours }
    }
}

/// floor(n/d + 1/2), d > 0.
fn nearest(n: i128, d: i128) -> i128 {
    (2 * n + d).div_euclid(2 * d)
}
