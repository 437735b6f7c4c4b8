//! A triangle that breaks an error target: the reason why one fraction bit fewer will not do.
//!
//! ```text
//!  v0 ├─ n_x columns ─┐      the major edge v0-v2 is vertical, in the first column of the guard band;
//!     │ ╲             │      v1 lies 1/256 px right of the centre of the last pixel of the last line,
//!     │    ╲          │ n_y  which is therefore the covered pixel behind the most additions;
//!     │       ╲       │      its exact value is next to the end of the range, 0 or 2^b - 1;
//!  v2 └──────────── v1┘      the vertex values are such that both increments round the same way.
//! ```
//! Formulae: `docs/machine.md` section 2, exact fill, s = 8, for this shape.

use crate::dyadic::Dyadic;
use crate::rounding::Rounding;
use crate::steps::{Screen, Steps};
use std::fmt;

/// Sub-pixel positions in a pixel: s = 8.
const P: i128 = 256;
/// Vertex differences tried for each increment.
const TRIED: i128 = 4096;
/// Differences along the edge that are kept, best first.
const KEPT: usize = 16;

/// What the error of every fragment must meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The rounded output stays in 0 to 2^b - 1, no clamp needed (bound 4).
    InRange,
    /// The error before the output rounding is at most this many LSB.
    AtMost(Dyadic),
}

/// The bits of a channel as far as they matter here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChannelBits {
    /// Output bits b.
    pub output: u32,
    /// Fraction bits e of the vertex values.
    pub vertex: u32,
}

/// A triangle, one of its pixels, and what a machine with too few fraction bits makes of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Witness {
    /// Fraction bits r that do not suffice.
    pub fraction_bits: u32,
    /// Bits of the channel; the vertex bits are at most `fraction_bits`.
    pub channel: ChannelBits,
    /// x and y in 2^-8 px, and the channel's value in 2^-e LSB.
    pub vertices: [(i32, i32, u64); 3],
    /// Column and line of the pixel.
    pub pixel: (u32, u32),
    /// Additions behind it.
    pub steps: Steps,
    /// The machine's value before the output rounding, LSB; r fraction bits.
    pub sum: Dyadic,
    /// The exact value, LSB, as numerator and denominator.
    pub exact: (i128, i128),
}

impl Witness {
    /// The output before it is cut to b bits: the sum rounded half up.
    #[must_use]
    pub fn output(&self) -> i128 {
        self.sum.round(0, Rounding::NearestHalfUp).numerator()
    }

    /// Whether the pixel misses `target`.
    fn misses(&self, target: Target) -> bool {
        match target {
            Target::InRange => !(0..1 << self.channel.output).contains(&self.output()),
            Target::AtMost(error) => {
                // |sum - n/d| > error, cross-multiplied.
                let (n, d) = self.exact;
                let bits = self.sum.fraction_bits().max(error.fraction_bits());
                let difference = || {
                    let sum = self.sum.scaled(bits)?.checked_mul(d)?;
                    let allowed = error.scaled(bits)?.checked_mul(d)?;
                    let exact = n.checked_mul(1i128.checked_shl(bits)?)?;
                    Some(sum.checked_sub(exact)?.unsigned_abs() > allowed.unsigned_abs())
                };
                difference().unwrap_or(false)
            }
        }
    }

    /// Searches a triangle that misses the target with `fraction_bits`; `None` if none was found.
    pub(crate) fn search(
        screen: Screen,
        channel: ChannelBits,
        rounding: Rounding,
        fraction_bits: u32,
        target: Target,
    ) -> Option<Witness> {
        let channel = ChannelBits { vertex: channel.vertex.min(fraction_bits), ..channel };
        let tops = (0..P).step_by(37);
        let shapes = tops.flat_map(|top| [127, 128, 101, 64, 1].map(|bottom| (top, bottom)));
        shapes
            .map(|(top, bottom)| Shape::new(screen, channel, rounding, fraction_bits, top, bottom))
            .find_map(|shape| shape.search(target))
    }
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "with {} fraction bits, triangle", self.fraction_bits)?;
        let [position, value] = [8, self.channel.vertex].map(|bits| (-f64::from(bits)).exp2());
        for (x, y, c) in self.vertices {
            write!(f, " ({}, {}: {})", f64::from(x) * position, f64::from(y) * position, c as f64 * value)?;
        }
        let (x, y) = self.pixel;
        let exact = self.exact.0 as f64 / self.exact.1 as f64;
        write!(f, ", pixel {x},{y}: {} additions give {} for {exact:.6}", self.steps.total(), self.sum)?;
        write!(f, ", output {} of 0..={}", self.output(), (1u64 << self.channel.output) - 1)
    }
}

/// The triangle without its vertex values, in units of 1/256 px from the first walked pixel's centre.
struct Shape {
    screen: Screen,
    channel: ChannelBits,
    rounding: Rounding,
    fraction_bits: u32,
    /// v0 lies this far above the first line's centre.
    top: i128,
    /// n_y and n_x of the pixel.
    steps: [i128; 2],
    /// u1 - u0, v1 - v0, v2 - v0.
    differences: [i128; 3],
    /// 2^(r-e): LSB of the vertex values in units of the accumulator.
    scale: i128,
    /// Which end of the range the errors drive at: +1 or -1.
    side: i128,
}

impl Shape {
    fn new(
        screen: Screen,
        channel: ChannelBits,
        rounding: Rounding,
        fraction_bits: u32,
        top: i128,
        bottom: i128,
    ) -> Shape {
        let Steps { lines, columns } = screen.max_steps();
        let steps = [lines.into(), columns.into()];
        Shape {
            screen,
            channel,
            rounding,
            fraction_bits,
            top,
            steps,
            differences: [steps[1] * P + 1, steps[0] * P + top, steps[0] * P + top + bottom],
            scale: 1 << (fraction_bits - channel.vertex),
            side: if rounding == Rounding::Floor { -1 } else { 1 },
        }
    }

    /// RN or floor of `n / d`, d > 0.
    fn round(&self, n: i128, d: i128) -> i128 {
        self.rounding.divide(n, d).expect("the divisor is a positive difference of coordinates")
    }

    /// Rounded start (relative to c0) and increment along the edge for c2 - c0 = `dc2`.
    fn edge(&self, dc2: i128) -> [i128; 2] {
        let dv2 = self.differences[2];
        [self.round(self.top * dc2 * self.scale, dv2), self.round(P * dc2 * self.scale, dv2)]
    }

    /// Numerator of the gradient along x over `area`, 2^-e LSB per 1/256 px.
    fn gradient(&self, dc1: i128, dc2: i128) -> i128 {
        dc1 * self.differences[2] - dc2 * self.differences[1]
    }

    fn area(&self) -> i128 {
        self.differences[0] * self.differences[2]
    }

    /// The differences c2 - c0 whose roundings along the edge drive the furthest.
    fn edge_differences(&self) -> Vec<i128> {
        let dv2 = self.differences[2];
        let driven = |dc2: i128| {
            let [start, step] = self.edge(dc2);
            let exact = (self.top + P * self.steps[0]) * dc2 * self.scale;
            self.side * ((start + self.steps[0] * step) * dv2 - exact)
        };
        let mut all: Vec<i128> = (-TRIED..=TRIED).collect();
        all.sort_by_cached_key(|dc2| (-driven(*dc2), dc2.abs()));
        all.truncate(KEPT);
        all
    }

    fn search(&self, target: Target) -> Option<Witness> {
        let top_value = ((1 << self.channel.output) - 1) << self.channel.vertex;
        let c1 = if self.side > 0 { top_value } else { 0 };
        let in_range = |c: i128| (0..=top_value).contains(&c);
        self.edge_differences().into_iter().find_map(|dc2| {
            (0..=TRIED)
                .map(|rise| self.side * rise)
                .filter(|dc1| in_range(c1 - dc1) && in_range(c1 - dc1 + dc2))
                .find_map(|dc1| self.missed(target, c1, dc1, dc2))
        })
    }

    /// The witness with these vertex values, if the last pixel misses the target.
    fn missed(&self, target: Target, c1: i128, dc1: i128, dc2: i128) -> Option<Witness> {
        let (c0, area, gradient) = (c1 - dc1, self.area(), self.gradient(dc1, dc2));
        let [start, along_edge] = self.edge(dc2);
        let along_span = self.round(gradient * P * self.scale, area);
        let sum = c0 * self.scale + start + self.steps[0] * along_edge + self.steps[1] * along_span;
        let sum = Dyadic::new(sum, self.fraction_bits)?;
        // v1 lies 1/256 px right of the pixel.
        let exact = (c1 * area - gradient, area << self.channel.vertex);
        let [x0, y0] = [P / 2 - P * i128::from(self.screen.guard_columns), P / 2 - self.top];
        let [du1, dv1, dv2] = self.differences;
        let c = [c0, c1, c0 + dc2];
        let vertex =
            |x: i128, y: i128, c: i128| Some((x.try_into().ok()?, y.try_into().ok()?, c.try_into().ok()?));
        let witness = Witness {
            fraction_bits: self.fraction_bits,
            channel: self.channel,
            vertices: [vertex(x0, y0, c[0])?, vertex(x0 + du1, y0 + dv1, c[1])?, vertex(x0, y0 + dv2, c[2])?],
            pixel: (self.screen.width - 1, self.screen.height - 1),
            steps: self.screen.max_steps(),
            sum,
            exact,
        };
        witness.misses(target).then_some(witness)
    }
}
