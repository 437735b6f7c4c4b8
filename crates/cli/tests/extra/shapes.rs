//! Triangle files with values of the user's own, and the plane of each value by this test's own arithmetic.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::fmt::Write as _;

/// A channel as a machine is given it.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    pub kind: &'static str,
    pub bits: u32,
    pub fraction: u32,
    pub vertex: u32,
}

impl Own {
    /// Largest magnitude of an output that a vertex may ask for, LSB.
    pub fn limit(self) -> f64 {
        if self.kind == "unorm" {
            2f64.powi(self.bits as i32) - 1.0
        } else {
            2f64.powi(self.bits as i32 - 1) - 1.0
        }
    }

    /// LSB that a 1 of the file stands for.
    pub fn unit(self) -> f64 {
        if self.kind == "unorm" { self.limit() } else { 1.0 }
    }

    /// The range of the file.
    pub fn range(self) -> [f64; 2] {
        if self.kind == "unorm" { [0.0, 1.0] } else { [-self.limit(), self.limit()] }
    }
}

/// What a program would draw.
pub struct Drawing {
    pub width: u32,
    pub height: u32,
    pub mode: &'static str,
    pub own: Vec<Own>,
    pub triangles: Vec<Shape>,
}

/// Corners on the grid of 1/256 px, a depth, and by channel the values at the corners.
pub struct Shape {
    pub corners: [[f64; 2]; 3],
    pub z: f64,
    pub values: Vec<[f64; 3]>,
}

impl Drawing {
    /// The triangle file.
    pub fn file(&self) -> String {
        let mut text =
            format!("size {} {}\nmode {}\nextra {}\n", self.width, self.height, self.mode, self.own.len());
        for shape in &self.triangles {
            text += "T";
            for [x, y] in shape.corners {
                _ = write!(text, "  {x} {y} {} 0.2 0.4 0.6 0", shape.z);
            }
            text += "\nX";
            for corner in 0..3 {
                shape.values.iter().for_each(|of| _ = write!(text, " {}", of[corner]));
            }
            text += "\n";
        }
        text
    }

    /// What the machine must be told, the screen too.
    pub fn settings(&self) -> Vec<String> {
        let (width, height) = (self.width, self.height);
        let mut list = vec![format!("screen.width={width}"), format!("screen.height={height}")];
        list.push(format!("channels.extra={}", self.own.len()));
        for (i, of) in self.own.iter().enumerate() {
            list.push(format!("channels.e{i}_kind={}", of.kind));
            list.push(format!("channels.e{i}_bits={}", of.bits));
            list.push(format!("channels.e{i}_fraction={}", of.fraction));
            list.push(format!("channels.e{i}_vertex={}", of.vertex));
        }
        list
    }

    /// The value of a channel where this triangle shows at a pixel, LSB.
    pub fn plane(&self, triangle: usize, channel: usize, (x, y): (usize, usize)) -> f64 {
        let Shape { corners: [a, b, c], values, .. } = &self.triangles[triangle];
        let p = [x as f64 + 0.5, y as f64 + 0.5];
        let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let weights = [area(p, *b, *c), area(*a, p, *c), area(*a, *b, p)];
        let sum: f64 = weights.iter().zip(values[channel]).map(|(weight, value)| weight * value).sum();
        self.own[channel].unit() * sum / area(*a, *b, *c)
    }
}

/// Random triangles on top of each other and over the sides of a small screen, each at a depth of its own.
pub fn random(seed: u64) -> Drawing {
    let rng = &mut StdRng::seed_from_u64(seed);
    let count = rng.random_range(1..=4);
    let own = (0..count).map(|_| channel(rng)).collect::<Vec<_>>();
    let triangles = (0..rng.random_range(2..=6)).map(|place| shape(rng, place, &own)).collect();
    let mode = ["gouraud", "flat"][rng.random_range(0..2)];
    Drawing { width: 40, height: 32, mode, own, triangles }
}

fn channel(rng: &mut StdRng) -> Own {
    let kind = ["unorm", "signed", "floor"][rng.random_range(0..3)];
    // 12 bits are the fewest with a bound, and words have at most 56.
    let (bits, fraction) = (rng.random_range(2..=32), rng.random_range(14..=20));
    Own { kind, bits, fraction, vertex: rng.random_range(0..=8) }
}

fn shape(rng: &mut StdRng, place: i32, own: &[Own]) -> Shape {
    let grid = |value: f64| (value * 256.0).round() / 256.0;
    let corners =
        std::array::from_fn(|_| [grid(rng.random_range(-12.0..52.0)), grid(rng.random_range(-12.0..44.0))]);
    let value = |rng: &mut StdRng, of: &Own| {
        let [low, high] = of.range();
        match rng.random_range(0..6) {
            0 => low,
            1 => high,
            2 => (low + high) / 2.0 - rng.random_range(0.0..0.5) * (high - low).min(2.0),
            _ => rng.random_range(low..=high),
        }
    };
    let values = own.iter().map(|of| std::array::from_fn(|_| value(rng, of))).collect();
    let z = 0.05 + 0.9 * f64::from(place * 5 % 7) / 7.0;
    Shape { corners, z, values }
}
