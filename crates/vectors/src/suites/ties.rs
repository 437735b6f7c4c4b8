//! Quotients of SETUP that lie half way between two words, and show: a tie rounded the wrong way moves the accumulator
//! from one output value to the next.
//!
//! Such triangles are solved for. The area is a power of two, so that quotients are ties at all; then vertex values are
//! drawn until the word at one pixel is a multiple of 2^r. Formulas and names are those of `docs/machine.md`, section 2,
//! for exact fill and exact edges. Textbook fill divides by whole lines and slopes step otherwise: there is none here.

use super::pen::{Pen, case};
use super::{Case, Triangle};
use edgewalk_machine::{Fill, Plan, Precision};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Draws before a machine is taken to have no such triangle.
const PATIENCE: u32 = 1 << 18;

/// What is to be a tie.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tie {
    /// The first value.
    Start,
    /// The step with a carry, where the remainders of step and gradient sum to half the area.
    Half,
    /// Like `Half`, where they sum to one and a half.
    ThreeHalves,
}

const TIES: [(Tie, &str); 3] =
    [(Tie::Start, "start"), (Tie::Half, "step_with_carry"), (Tie::ThreeHalves, "step_with_carry_and_borrow")];

pub(super) fn cases(machine: &Plan) -> Vec<Case> {
    if machine.fill == Fill::Textbook {
        return Vec::new();
    }
    let mut cases = Vec::new();
    for (column, (tie, name)) in TIES.into_iter().enumerate() {
        for (line, (channel, of)) in [(machine.z, "z"), (machine.color, "color")].into_iter().enumerate() {
            // Depths near: what lies on the screen already is farther.
            let full = channel.max() << channel.vertex_fraction;
            let solved = solve(machine, channel, tie, if of == "z" { full / 6 } else { full });
            cases.extend(solved.map(|solved| {
                let at = [5 * column as u32, 5 * line as u32];
                case(&format!("tie_of_{name}_{of}"), [triangle(machine, &solved, at, of == "z")])
            }));
        }
    }
    cases
}

/// Three vertices in centre coordinates around the pixel (0, 0), sorted, and their values in 2^-e LSB.
struct Solved {
    at: [(i64, i64); 3],
    values: [u64; 3],
}

/// The triangle at the port, moved to the lower right of the screen, which other corners leave alone.
fn triangle(machine: &Plan, solved: &Solved, at: [u32; 2], of_z: bool) -> Triangle {
    let pen = Pen::new(machine);
    let corner = [machine.width.saturating_sub(14) + at[0], machine.height.saturating_sub(9) + at[1]];
    let bits = machine.widths().center_fraction;
    let share = |value: u64, channel: Precision| {
        value as f64 / (channel.max() << channel.vertex_fraction) as f64 // at most 2^53: exact
    };
    std::array::from_fn(|i| {
        let place =
            |centre: i64, pixel: u32| centre as f64 / f64::from(1u32 << bits) + f64::from(pixel) + 0.5;
        let (z, color) = match of_z {
            true => (share(solved.values[i], machine.z), 0.5),
            false => (0.0, share(solved.values[i], machine.color)),
        };
        let (u, v) = solved.at[i];
        pen.vertex((place(u, corner[0]), place(v, corner[1])), [z, color, color, color])
    })
}

/// A triangle and values up to the largest that show the tie; `None` if none was drawn.
fn solve(machine: &Plan, channel: Precision, tie: Tie, largest: u64) -> Option<Solved> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut shape = None;
    for n in 0..PATIENCE {
        if n % 4096 == 0 {
            shape = Shape::draw(machine, channel, tie, &mut random);
        }
        let Some(shape) = &shape else { continue };
        let values: [u64; 3] = std::array::from_fn(|_| random.random_range(0..=largest));
        if let Some(values) = shape.with_values(values, largest, tie) {
            return Some(Solved { at: shape.at, values });
        }
    }
    None
}

/// A triangle without values: its area, and what its values are weighted with.
struct Shape {
    at: [(i64, i64); 3],
    channel: Precision,
    /// t + r - e, r - e.
    scale: [u32; 2],
    area: i128,
    major_right: bool,
    /// q of the major edge.
    q: i128,
    /// From the first vertex to the centre of the first pixel.
    to_first: [i128; 2],
}

impl Shape {
    /// A shape whose area is the power of two that makes ties; it has a pixel where the tie shows.
    fn draw(machine: &Plan, channel: Precision, tie: Tie, random: &mut Pcg64Mcg) -> Option<Shape> {
        let t = machine.widths().center_fraction;
        let step = channel.fraction - channel.vertex_fraction;
        match tie {
            Tie::Start => Shape::speck(channel, t, step, random),
            Tie::Half | Tie::ThreeHalves => {
                (0..2000).find_map(|_| Shape::leaning(machine, channel, t, step, random))
            }
        }
    }

    /// Flat at the bottom, its apex straight above the centre of the one pixel it covers.
    fn speck(channel: Precision, t: u32, step: u32, random: &mut Pcg64Mcg) -> Option<Shape> {
        let bits = (step + 1).max(2);
        let (low, high) = (bits.saturating_sub(t).max(1), (bits - 1).min(t));
        let i = (low <= high).then(|| random.random_range(low..=high))?;
        let (width, height) = (1i64 << i, 1i64 << (bits - i));
        let right = random.random_range(0..width / 2) * 2 + 1;
        let at = [(0, 1 - height), (right - width, 1), (right, 1)];
        Shape::of(at, channel, [t + step, step], t)
    }

    /// No side level, carry in the step from the first line (0) to the second, whose first pixel is covered.
    fn leaning(
        machine: &Plan,
        channel: Precision,
        t: u32,
        step: u32,
        random: &mut Pcg64Mcg,
    ) -> Option<Shape> {
        let one = 1i64 << t;
        let far = (4 * one).min(i64::from(machine.height) * one / 3);
        if far < one {
            return None; // a screen of one or two lines has no room for it
        }
        let area = 1i64 << (t + step + 2);
        let v0 = random.random_range(1 - one..=0);
        // Whole odd numbers du2, dv2 without a common divisor; then du1 dv2 - du2 dv1 = ±area has solutions.
        let dv2 = random.random_range(one..=far) | 1;
        let du2 = random.random_range(-far..=far) | 1;
        let signed = if random.random() { area } else { -area };
        let dv1 = (-signed).rem_euclid(dv2) * inverse(du2.rem_euclid(dv2), dv2)? % dv2;
        let du1 = (signed + du2 * dv1) / dv2;
        let u0 = random.random_range(-one..=one);
        if du1.abs() > far {
            return None;
        }
        let at = [(u0, v0), (u0 + du1, v0 + dv1), (u0 + du2, v0 + dv2)];
        let shape = Shape::of(at, channel, [t + step, step], t)?;
        shape.covers_second_line(t).then_some(shape)
    }

    /// The major edge is 0-2; line 0 is the first.
    fn of(at: [(i64, i64); 3], channel: Precision, scale: [u32; 2], t: u32) -> Option<Shape> {
        let d = |i: usize| (i128::from(at[i].0 - at[0].0), i128::from(at[i].1 - at[0].1));
        let ((du1, dv1), (du2, dv2)) = (d(1), d(2));
        let area = du1 * dv2 - du2 * dv1;
        let major_right = area < 0;
        // The first column right of the major edge on line 0, and the step to the next line.
        let one = 1i128 << t;
        let (u0, v0) = (i128::from(at[0].0), i128::from(at[0].1));
        let on_edge = u0 * dv2 - v0 * du2;
        let column = (on_edge + dv2 * one - 1).div_euclid(dv2 * one);
        let first = column - i128::from(major_right);
        (area != 0).then(|| Shape {
            at,
            channel,
            scale,
            area: area.abs(),
            major_right,
            q: du2.div_euclid(dv2),
            to_first: [first * one - u0, -v0],
        })
    }

    /// The step to line 1 carries, and its first pixel lies inside.
    fn covers_second_line(&self, t: u32) -> bool {
        let one = 1i128 << t;
        let [(u0, v0), (u1, v1), (u2, v2)] = self.at.map(|(u, v)| (i128::from(u), i128::from(v)));
        let (du, dv) = (u2 - u0, v2 - v0);
        let column = |line: i128| {
            let on_edge = u0 * dv + (line * one - v0) * du;
            (on_edge + dv * one - 1).div_euclid(dv * one)
        };
        let carries = column(1) - column(0) == self.q + 1;
        let (x, y) = ((column(1) - i128::from(self.major_right)) * one, one);
        let sign = if self.major_right { -1 } else { 1 };
        let inside =
            |a: (i128, i128), b: (i128, i128)| sign * ((b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0)) > 0;
        let corners = [(u0, v0), (u1, v1), (u2, v2)];
        carries && (0..3).all(|i| inside(corners[i], corners[(i + 1) % 3]))
    }

    /// The values, all moved by the same amount so that the tie shows; `None` if these differences have no tie.
    fn with_values(&self, values: [u64; 3], largest: u64, tie: Tie) -> Option<[u64; 3]> {
        let sign = if self.major_right { -1 } else { 1 };
        let dc = |i: usize| sign * (i128::from(values[i]) - i128::from(values[0]));
        let d = |i: usize| (i128::from(self.at[i].0 - self.at[0].0), i128::from(self.at[i].1 - self.at[0].1));
        let ((du1, dv1), (du2, dv2)) = (d(1), d(2));
        let nx = dc(1) * dv2 - dc(2) * dv1;
        let ny = du1 * dc(2) - du2 * dc(1);
        let start = Quotient::of((self.to_first[0] * nx + self.to_first[1] * ny) << self.scale[1], self.area);
        let gradient = Quotient::of(nx << self.scale[0], self.area);
        let step = Quotient::of((ny + self.q * nx) << self.scale[0], self.area);
        let with_carry = Quotient::of((ny + (self.q + 1) * nx) << self.scale[0], self.area);
        let r = self.channel.fraction;
        let half = if r == 0 { 0 } else { 1i128 << (r - 1) };
        let rests = 2 * (gradient.rest + step.rest);
        let word = match tie {
            // Below 0 SETUP divides the complement, and a tie is no comparison of equals there.
            Tie::Start => (start.floor >= 0 && start.tie(self.area)).then(|| start.rounded(self.area)),
            Tie::Half => {
                (rests == self.area).then(|| start.rounded(self.area) + with_carry.rounded(self.area))
            }
            Tie::ThreeHalves => {
                (rests == 3 * self.area).then(|| start.rounded(self.area) + with_carry.rounded(self.area))
            }
        }? + half;
        // What is missing to a multiple of 2^r must be whole units of the vertex values.
        let missing = (-(word + (i128::from(values[0]) << self.scale[1]))).rem_euclid(1 << r);
        let unit = 1i128 << self.scale[1];
        let moved = (missing % unit == 0).then_some(missing / unit)? as u64; // below 2^e
        let moved = values.map(|value| value + moved);
        moved.iter().all(|value| *value <= largest).then_some(moved)
    }
}

/// A quotient rounded down, and what is left.
struct Quotient {
    floor: i128,
    rest: i128,
}

impl Quotient {
    fn of(numerator: i128, area: i128) -> Quotient {
        Quotient { floor: numerator.div_euclid(area), rest: numerator.rem_euclid(area) }
    }

    fn tie(&self, area: i128) -> bool {
        2 * self.rest == area
    }

    fn rounded(&self, area: i128) -> i128 {
        self.floor + i128::from(2 * self.rest >= area)
    }
}

/// The inverse of `a` modulo `m`, if there is one.
fn inverse(a: i64, m: i64) -> Option<i64> {
    let (mut r, mut next, mut x, mut next_x) = (m, a, 0, 1);
    while next != 0 {
        let quotient = r / next;
        (r, next) = (next, r - quotient * next);
        (x, next_x) = (next_x, x - quotient * next_x);
    }
    (r == 1).then(|| x.rem_euclid(m))
}
