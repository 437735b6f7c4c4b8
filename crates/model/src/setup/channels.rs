//! First values and increments of every channel: exact divisions, rounded once, kept modulo 2^(b+r).

use super::edges::Parts;
use super::round::round_div;
use super::sort::{Corner, Sorted};
use crate::tokens::{Prim, word_masks};
use edgewalk_machine::{Channel, Fill, Plan};

/// Fills in `start`, `delta` and `gradient` of a triangle whose edges are known.
pub(super) fn prepare<const C: usize>(plan: &Plan, sorted: &Sorted<C>, parts: &Parts, prim: &mut Prim<C>) {
    let masks = word_masks::<C>(plan);
    let word = |i: usize, value: i128| value as u64 & masks[i];
    for (i, channel) in plan.planes() {
        let plane = Plane::new(plan, sorted, i, channel);
        prim.gradient[i] = word(i, plane.gradient());
        if plan.polygon.is_there() {
            let [x, y] = prim.start_pixel;
            prim.delta[0][i] = word(i, plane.step(0));
            prim.start[0][i] = word(i, plane.at(x.into(), y.into()));
            continue;
        }
        match plan.fill {
            Fill::Exact => {
                if prim.major_right {
                    prim.gradient[i] = word(i, -plane.gradient());
                }
                let q = i128::from(prim.major.q);
                prim.delta[0][i] = word(i, plane.step(q));
                prim.delta[1][i] = word(i, plane.step(q + 1));
                let px = i64::from(prim.major.c) - i64::from(prim.major_right);
                prim.start[0][i] = word(i, plane.at(px, i64::from(prim.line)));
            }
            Fill::Textbook => {
                for part in 0..2 {
                    if parts.lines[part] > 0 {
                        let (from, to) = sorted.left_edge(part);
                        let (start, delta) = left_edge(plan, from, to, parts.first[part], i, channel);
                        prim.start[part][i] = word(i, start);
                        prim.delta[part][i] = word(i, delta);
                    }
                }
            }
        }
    }
}

/// r - e, and half: the 1/2 that turns the final truncation into rounding, 2^(r-1) (0 if r = 0); a channel that is to be
/// truncated has none.
fn scale(channel: &Channel) -> (u32, i128) {
    let half = if channel.kind.is_rounded() { (1i128 << channel.fraction) >> 1 } else { 0 };
    (channel.fraction - channel.vertex_fraction, half)
}

/// Textbook fill: first value and increment a line along the left edge `a`-`b`, on line `j` (ch. 7.10).
fn left_edge<const C: usize>(
    plan: &Plan,
    a: &Corner<C>,
    b: &Corner<C>,
    j: i64,
    i: usize,
    channel: &Channel,
) -> (i128, i128) {
    let (shift, half) = scale(channel);
    let p = 1i64 << plan.widths().center_fraction;
    let dc = i128::from(b.values[i] - a.values[i]);
    let dy = i128::from(b.v - a.v);
    let start =
        round_div((dc * i128::from(j * p - a.v)) << shift, dy) + (i128::from(a.values[i]) << shift) + half;
    (start, round_div((dc * i128::from(p)) << shift, dy))
}

/// A channel as a plane over the screen (ch. 7.7): numerators of its slopes over |area|.
struct Plane<'a, const C: usize> {
    top: &'a Corner<C>,
    /// Nx and Ny, 2^-e LSB times 2^-t px.
    slope: [i128; 2],
    /// |area|, 2^-2t px².
    area: i128,
    /// Value of the top vertex, 2^-e LSB.
    value: i128,
    /// log2 P.
    t: u32,
    shift: u32,
    half: i128,
}

impl<'a, const C: usize> Plane<'a, C> {
    fn new(plan: &Plan, sorted: &'a Sorted<C>, i: usize, channel: &Channel) -> Self {
        let [top, b, c] = &sorted.corners;
        let area = sorted.area();
        let [dc1, dc2] = [b, c].map(|to| i128::from(area.signum() * (to.values[i] - top.values[i])));
        let difference = |to: i64, from: i64| i128::from(to - from);
        let (shift, half) = scale(channel);
        Plane {
            top,
            slope: [
                dc1 * difference(c.v, top.v) - dc2 * difference(b.v, top.v),
                difference(b.u, top.u) * dc2 - difference(c.u, top.u) * dc1,
            ],
            area: i128::from(area.abs()),
            value: i128::from(top.values[i]),
            t: plan.widths().center_fraction,
            shift,
            half,
        }
    }

    /// gx: increment of a pixel to the right, 2^-r LSB.
    fn gradient(&self) -> i128 {
        round_div(self.slope[0] << (self.t + self.shift), self.area)
    }

    /// Increment of a line down and `q` pixels to the right, divided once, 2^-r LSB.
    fn step(&self, q: i128) -> i128 {
        round_div((self.slope[1] + q * self.slope[0]) << (self.t + self.shift), self.area)
    }

    /// Value at the centre of pixel (x, y), plus 1/2 LSB, 2^-r LSB.
    fn at(&self, x: i64, y: i64) -> i128 {
        let [nx, ny] = self.slope;
        let (dx, dy) = ((x << self.t) - self.top.u, (y << self.t) - self.top.v);
        let moved = (i128::from(dx) * nx + i128::from(dy) * ny) << self.shift;
        round_div(moved, self.area) + (self.value << self.shift) + self.half
    }
}
