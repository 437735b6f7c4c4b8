//! A light's map, and what random triangles hardly ever meet in it: the texels of its corners and sides, what lies one beside them,
//! depths exactly those of a texel and one LSB off, before and behind all that the map can say, and values that would alias.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::Plan;

/// The words of the map, by address: depth 0 in the first texel, all ones in the last, anything between elsewhere; what lies beyond
/// a side that is no power of two is 0, so that a look at it shows. With `shadow.transmits` nothing is left of the light in the last texel,
/// all of it in the one before, and anything in the others.
pub(super) fn map(machine: &Plan) -> Vec<u32> {
    let (size, side) = (machine.shadow.size, machine.shadow.side_bits());
    (0..1u32 << (2 * side))
        .map(|address| {
            let (ty, tx) = (address >> side, address & ((1 << side) - 1));
            if tx >= size || ty >= size {
                0
            } else if machine.shadow.transmits() {
                word(machine, tx, ty) << machine.color.bits | left(machine, tx, ty)
            } else {
                word(machine, tx, ty)
            }
        })
        .collect()
}

fn word(machine: &Plan, tx: u32, ty: u32) -> u32 {
    let (size, most) = (machine.shadow.size, farthest(machine));
    match (tx, ty) {
        (0, 0) => 0,
        _ if tx == size - 1 && ty == size - 1 => most,
        _ => (tx * 0x9e37 + ty * 0x79b9 + 0x7f4a).wrapping_mul(0x85eb_ca6b) >> 7 & most,
    }
}

/// What is left of the light, b bits.
fn left(machine: &Plan, tx: u32, ty: u32) -> u32 {
    let (last, most) = (machine.shadow.size - 1, machine.color.max() as u32); // b <= 16 bits
    match (last - tx, last - ty) {
        (0, 0) => 0,
        (1, 0) => most,
        _ => (tx * 0x6d2b + ty * 0x3c6e + 0x51ed).wrapping_mul(0xc2b2_ae35) >> 9 & most,
    }
}

fn farthest(machine: &Plan) -> u32 {
    (1 << machine.shadow.depth_bits) - 1
}

/// Dots of one light-space value each, so that every decision is known.
pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    let dots = Dots { machine, pen: Pen::new(machine) };
    let (size, last) = (f64::from(machine.shadow.size), f64::from(machine.shadow.size - 1));
    let corners = [(0.0, 0.0), (last, 0.0), (0.0, last), (last, last)];
    let beside = [(-1.0, 0.0), (0.0, -1.0), (size, last), (last, size), (-1.0, -1.0), (size, size)];
    let beyond = f64::from(farthest(machine)) + 1.0;
    let guard = f64::from(1u32 << (machine.shadow.side_bits() + machine.shadow.guard_bits));
    // Whole maps away from the last texel, on each axis and on both.
    let whole = f64::from(1u32 << machine.shadow.side_bits());
    let turns = (1..1 << machine.shadow.guard_bits).flat_map(|k| {
        let away = f64::from(k) * whole;
        [(last + away, last), (last, last + away), (last - away - whole, last - away - whole)]
    });
    let at = |(x, y): (f64, f64)| f64::from(dots.word(x, y));
    let mut cases = vec![
        case("each_corner_around_its_depth", {
            corners.into_iter().flat_map(|c| [-1.0, 0.0, 1.0].map(|off| dots.dot(c, at(c) + off)))
        }),
        case("each_corner_rounded_to_its_depth", {
            // The last value that is rounded down, and the first that is rounded up.
            corners.into_iter().flat_map(|c| [dots.below_half(), 0.5].map(|off| dots.dot(c, at(c) + off)))
        }),
        case("edges_of_texels", {
            let off = dots.texel_lsb();
            corners
                .into_iter()
                .flat_map(move |(x, y)| [(x - off, y), (x, y - off), (x + 1.0 - off, y + 1.0 - off)])
                .map(|c| dots.dot(c, 1.0))
        }),
        case("one_beside_each_side", beside.map(|c| dots.dot(c, beyond / 2.0))),
        case("beside_the_map_and_behind_it", beside.map(|c| dots.dot(c, beyond))),
        case("whole_maps_away", turns.map(|c| dots.dot(c, beyond - 1.0))),
        case("the_ends_of_the_guard_band", {
            [(guard, 0.0), (-guard, 0.0), (0.0, guard), (0.0, -guard)].map(|c| dots.dot(c, 0.0))
        }),
        case("before_and_behind_the_map", {
            [
                -1.0,
                -2.0,
                -beyond,
                -2.0 * beyond,
                beyond - 1.0,
                beyond - 0.5,
                beyond,
                beyond + 1.0,
                2.0 * beyond,
            ]
            .into_iter()
            .flat_map(|d| [corners[0], corners[3]].map(|c| dots.dot(c, d)))
        }),
        case("known_behind_one_that_waits", {
            (0..12).map(|i| match i % 3 {
                0 => dots.dot(corners[3], beyond - 1.0),
                1 => dots.dot(beside[i % 6], 0.0),
                _ => dots.dot(corners[0], beyond),
            })
        }),
        case("what_is_left_along_the_last_line", {
            // Right before the texel's depth: lit, by as much as comes through.
            (0..machine.shadow.size.min(24))
                .map(f64::from)
                .map(|i| (last - i, last))
                .flat_map(|c| [0.0, 1.0].map(|off| dots.dot(c, (at(c) - off).max(0.0))))
        }),
        case("across_the_map", [dots.across(0.25), dots.across(0.75)]),
    ];
    if machine.shadow.projects() {
        cases.extend(divided(&dots));
        cases.push(case("weights_at_their_ends", dots.weights()));
    }
    cases
}

/// What PROJECT divides, and what it does not: weights of every sign and size, quotients on the edges of texels, on the far edge of the
/// map and right before it, depths that are rounded to the end.
fn divided(dots: &Dots) -> Vec<Case> {
    let most = f64::from((1u32 << dots.machine.shadow.light_bits) - 1);
    let half = dots.pen.weight();
    let side = f64::from(1u32 << dots.machine.shadow.side_bits());
    let weights = [1.0, 2.0, 3.0, half - 1.0, half, most - 1.0, most];
    vec![
        case("behind_the_light", {
            [0.0, -1.0, -half, -most].into_iter().flat_map(|w| {
                [[0.0, 0.0, 0.0, w], [w, w, w, w], [w / 2.0, w / 2.0, w / 2.0, w], [half, half, half, w]]
                    .map(|seen| dots.seen(seen))
            })
        }),
        case("the_far_edge", {
            weights.into_iter().flat_map(|w| {
                [
                    [w, 0.0, 0.0, w],
                    [0.0, w, 0.0, w],
                    [0.0, 0.0, w, w],
                    [w - 1.0, w - 1.0, w - 1.0, w],
                    [-1.0, 0.0, 0.0, w],
                ]
                .map(|seen| dots.seen(seen))
            })
        }),
        case("edges_of_texels_of_any_weight", {
            weights.into_iter().flat_map(|w| {
                let texel = (w / side).floor();
                [[texel, 0.0, 0.0, w], [texel - 1.0, texel, -1.0, w], [w - texel, w - texel - 1.0, 1.0, w]]
                    .map(|seen| dots.seen(seen))
            })
        }),
        case("weights_that_change_sign", {
            [0.25, 0.5].map(|z| {
                let (w, h) = dots.pen.size();
                let ends = [((0.0, 0.0), half), ((w, 0.0), -half / 4.0), ((0.0, h), most)];
                ends.map(|(at, weight)| {
                    let seen = [half / 8.0, half / 4.0, half / 2.0, weight];
                    dots.pen.seen(at, [z, 0.9, 0.5, 0.7], seen)
                })
            })
        }),
    ]
}

struct Dots<'a> {
    machine: &'a Plan,
    pen: Pen<'a>,
}

impl Dots<'_> {
    /// The depth that the map has for a texel.
    fn word(&self, x: f64, y: f64) -> u32 {
        word(self.machine, x as u32, y as u32)
    }

    /// 2^-e texel.
    fn texel_lsb(&self) -> f64 {
        0.5f64.powi(self.machine.shadow.vertex_fraction as i32)
    }

    /// The largest share of an LSB below a half that a vertex can have.
    fn below_half(&self) -> f64 {
        (0.5 - self.texel_lsb()).max(0.0)
    }

    /// One pixel, at these texels (their whole parts are the texel) and this depth in the map's LSB.
    fn dot(&self, (x, y): (f64, f64), d: f64) -> Triangle {
        // Nearer and nearer, so that every one is seen.
        let at = [(2.0, 1.0), (3.5, 1.0), (2.0, 2.5)];
        std::array::from_fn(|i| self.pen.lit(at[i], [0.0, 0.9, 0.5, 0.7], [x, y, d]))
    }

    /// One pixel of these light-space values.
    fn seen(&self, light: [f64; 4]) -> Triangle {
        let at = [(2.0, 1.0), (3.5, 1.0), (2.0, 2.5)];
        std::array::from_fn(|i| self.pen.seen(at[i], [0.0, 0.9, 0.5, 0.7], light))
    }

    /// One pixel of every place, 0, one LSB beside it, half of the weight, the weight and one LSB beside that; of weights 0 and 1, below 0,
    /// and the largest.
    fn weights(&self) -> Vec<Triangle> {
        let most = f64::from(self.machine.shadow.light_bits).exp2() - 1.0;
        let mut dots = Vec::new();
        for w in [most, most - 1.0, 1.0, 2.0, 0.0, -1.0, -most] {
            let places = [-most, -1.0, 0.0, 1.0, (w / 2.0).floor(), w - 1.0, w, w + 1.0, most];
            for (i, x) in places.into_iter().enumerate() {
                let [y, z] = [3, 7].map(|turn| places[(i * turn + 1) % places.len()]);
                for light in [[x, y, z, w], [1.0, w / 2.0, x, w]] {
                    let at = [(2.0, 1.0), (3.5, 1.0), (2.0, 2.5)];
                    dots.push(at.map(|at| self.pen.seen(at, [0.0, 0.9, 0.5, 0.7], light)));
                }
            }
        }
        dots
    }

    /// Over much of the screen, from one side of the map beyond the other, from before it to behind it.
    fn across(&self, z: f64) -> Triangle {
        let (size, depth) = (f64::from(self.machine.shadow.size), f64::from(farthest(self.machine)));
        let (w, h) = self.pen.size();
        let ends = [(0.0, 0.0, [-2.0, -2.0, -depth / 4.0]), (w, 0.0, [size + 2.0, 0.0, depth * 1.25])];
        let third = (0.0, h, [0.0, size + 2.0, depth / 2.0]);
        [ends[0], ends[1], third].map(|(x, y, light)| self.pen.lit((x, y), [z, 0.9, 0.5, 0.7], light))
    }
}
