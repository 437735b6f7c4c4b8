//! The rule and the values in exact integers, written from the definitions, not from the machine.
#![allow(dead_code, reason = "every test file uses a part")]

use edgewalk_model::tokens::Fragment;
use edgewalk_model::{DrawState, Event, Frame, Stalls, render_with};
use edgewalk_numerics::{Machine, PortVertex};
use rand::Rng;

pub type Triangle = [PortVertex; 3];

/// Every fragment is read, whatever is stored.
pub const ALWAYS: DrawState = DrawState { depth_func: 7, depth_write: true, clear: [0; 3] };

pub fn machine(settings: &[(&str, &str)]) -> Machine {
    let mut machine = Machine::default();
    for (key, value) in settings {
        machine.set(key, value).expect("a key of the machine");
    }
    machine.check().expect("a machine that can be built");
    machine
}

pub fn vertex(x: i32, y: i32, value: [u64; 4]) -> PortVertex {
    PortVertex { x, y, value }
}

/// Column and line of an address.
pub fn place(machine: &Machine, addr: u32) -> (i64, i64) {
    let bits = machine.widths().x;
    (i64::from(addr & ((1 << bits) - 1)), i64::from(addr >> bits))
}

/// Twice the signed distance of point (px, py) right of the edge a-b, times its height; all in 2^-(s+1) px.
fn right_of(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i64 {
    (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0])
}

/// Centre of a pixel and a vertex, both in 2^-(s+1) px.
fn centre(machine: &Machine, x: i64, y: i64) -> [i64; 2] {
    [x, y].map(|c| (2 * c + 1) << machine.subpixel_bits)
}

fn point(v: &PortVertex) -> [i64; 2] {
    [2 * i64::from(v.x), 2 * i64::from(v.y)]
}

/// Half-open in both axes: an odd number of edges crosses the line through the centre at or left of it.
pub fn inside(machine: &Machine, triangle: &Triangle, x: i64, y: i64) -> bool {
    let p = centre(machine, x, y);
    let crossed = (0..3).filter(|&i| {
        let (a, b) = (point(&triangle[i]), point(&triangle[(i + 1) % 3]));
        let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        a[1] <= p[1] && p[1] < b[1] && right_of(a, b, p) >= 0
    });
    crossed.count() % 2 == 1
}

/// Exact value of channel `i` at a pixel's centre, as numerator and positive denominator, in LSB.
pub fn exact_value(machine: &Machine, triangle: &Triangle, i: usize, x: i64, y: i64) -> (i128, i128) {
    let p = centre(machine, x, y);
    let corner = triangle.map(|v| point(&v));
    let weight = |a: usize, b: usize| i128::from(right_of(corner[a], corner[b], p));
    let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
    let sum: i128 = weights.iter().sum();
    let moment: i128 = (0..3).map(|k| weights[k] * i128::from(triangle[k].value[i])).sum();
    (moment * sum.signum(), sum.abs() << machine.channels()[i].vertex_fraction)
}

/// Draws triangles and holds every fragment against the exact rule and the exact values.
pub struct Check<'a> {
    machine: &'a Machine,
    triangles: &'a [Triangle],
    /// Number of the triangle that covered a pixel last, plus 1.
    seen: Vec<usize>,
    /// The triangle whose fragments arrive.
    current: usize,
    /// Pixels compared with the rule.
    pub pixels: u64,
    /// Fragments whose values were compared.
    pub fragments: u64,
    /// Pixels where machine and rule differ.
    pub wrong: Vec<(usize, i64, i64)>,
    /// Largest |output - exact|, LSB, Z, R, G, B.
    pub error: [f64; 4],
    /// Fragments of a pixel over all triangles.
    pub count: Vec<u32>,
}

impl<'a> Check<'a> {
    pub fn run(machine: &'a Machine, triangles: &'a [Triangle], stalls: Stalls) -> (Check<'a>, Frame) {
        let pixels = (machine.width * machine.height) as usize;
        let mut check = Check {
            machine,
            triangles,
            seen: vec![0; pixels],
            current: 0,
            pixels: 0,
            fragments: 0,
            wrong: Vec::new(),
            error: [0.0; 4],
            count: vec![0; pixels],
        };
        let hook = |event: Event| {
            if let Event::Fragment(fragment) = event {
                check.fragment(fragment);
            }
        };
        let frame = render_with(machine, triangles.iter().copied(), ALWAYS, stalls, hook);
        check.arrive(triangles.len());
        (check, frame)
    }

    fn index(&self, x: i64, y: i64) -> usize {
        (y * i64::from(self.machine.width) + x) as usize
    }

    fn fragment(&mut self, fragment: &Fragment) {
        self.arrive(fragment.id as usize);
        let (x, y) = place(self.machine, fragment.addr);
        let index = self.index(x, y);
        if self.seen[index] == self.current + 1 {
            self.wrong.push((self.current, x, y)); // twice
        }
        self.seen[index] = self.current + 1;
        self.count[index] += 1;
        self.fragments += 1;
        let output = [fragment.z, fragment.rgb[0], fragment.rgb[1], fragment.rgb[2]];
        for (i, output) in output.into_iter().enumerate() {
            let (n, d) = exact_value(self.machine, &self.triangles[self.current], i, x, y);
            let error = (i128::from(output) * d - n).unsigned_abs() as f64 / d as f64;
            self.error[i] = self.error[i].max(error);
        }
    }

    /// Closes the triangles before `next`.
    fn arrive(&mut self, next: usize) {
        assert!(next >= self.current, "fragments of triangle {} after those of {}", next, self.current);
        while self.current < next {
            self.close();
            self.current += 1;
        }
    }

    fn close(&mut self) {
        let triangle = &self.triangles[self.current];
        let s = self.machine.subpixel_bits;
        let range = |c: [i32; 3], side: u32| {
            let (low, high) = (c.into_iter().min().unwrap_or(0) >> s, c.into_iter().max().unwrap_or(0) >> s);
            (i64::from(low) - 1).max(0)..=(i64::from(high) + 1).min(i64::from(side) - 1)
        };
        for y in range(triangle.map(|v| v.y), self.machine.height) {
            for x in range(triangle.map(|v| v.x), self.machine.width) {
                self.pixels += 1;
                let drawn = self.seen[self.index(x, y)] == self.current + 1;
                if drawn != inside(self.machine, triangle, x, y) {
                    self.wrong.push((self.current, x, y));
                }
            }
        }
    }

    /// The demand: coverage equal everywhere, z and colour within 1 LSB of the exact value.
    pub fn passes(&self) {
        assert!(self.pixels > 0 && self.fragments > 0, "nothing was checked");
        if let Some((number, x, y)) = self.wrong.first() {
            panic!("pixel ({x}, {y}) of triangle {number}: {:?}", self.triangles[*number]);
        }
        for (i, error) in self.error.iter().enumerate() {
            assert!(*error <= 1.0, "channel {i} is {error} LSB off");
        }
    }
}

/// A random value for every channel.
pub fn random_values(machine: &Machine, rng: &mut impl Rng) -> [u64; 4] {
    machine.channels().map(|c| rng.random_range(0..=c.max() << c.vertex_fraction))
}

/// A random triangle around the screen whose corners lie within `size` px of each other.
pub fn random_triangle(machine: &Machine, size: f64, rng: &mut impl Rng) -> Triangle {
    let one = f64::from(1u32 << machine.subpixel_bits);
    let limit = f64::from((1u32 << machine.guard_bits) - 1);
    let middle = [machine.width, machine.height].map(|side| rng.random_range(0.0..f64::from(side)));
    std::array::from_fn(|_| {
        let c = middle.map(|m| (m + rng.random_range(-0.5..=0.5) * size).clamp(-limit, limit) * one);
        vertex(c[0].round() as i32, c[1].round() as i32, random_values(machine, rng))
    })
}
