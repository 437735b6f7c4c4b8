//! The rule and the values in exact integers, written from the definitions, not from the machine.
#![allow(dead_code, reason = "every test file uses a part")]

use edgewalk_machine::{Machine, Plan, PortVertex};
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{DrawState, Event, Frame, Inputs, Memory, Model, Outputs, Stalls, Write, render_with};
use rand::Rng;
use std::collections::HashMap;

pub type Triangle = [PortVertex; 3];

/// Every fragment is read, whatever is stored.
pub const ALWAYS: DrawState = DrawState { depth_func: 7, depth_write: true, clear: [0; 3] };

pub fn machine(settings: &[(&str, &str)]) -> Plan {
    let mut machine = Machine::default();
    for (key, value) in settings {
        machine.set(key, value).expect("a key of the machine");
    }
    machine.plan().expect("a machine that can be built")
}

pub fn vertex(x: i32, y: i32, value: [u64; 4]) -> PortVertex {
    PortVertex { x, y, value }
}

/// Column and line of an address.
pub fn place(machine: &Plan, addr: u32) -> (i64, i64) {
    let bits = machine.widths().x;
    (i64::from(addr & ((1 << bits) - 1)), i64::from(addr >> bits))
}

/// Z, R, G, B of a fragment, LSB.
pub fn outputs(fragment: &Fragment) -> [u64; 4] {
    let [r, g, b] = fragment.rgb.channels().map(u64::from);
    [u64::from(fragment.z), r, g, b]
}

/// Twice the signed distance of point (px, py) right of the edge a-b, times its height; all in 2^-(s+1) px.
fn right_of(a: [i64; 2], b: [i64; 2], p: [i64; 2]) -> i64 {
    (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0])
}

/// Centre of a pixel and a vertex, both in 2^-(s+1) px.
fn centre(machine: &Plan, x: i64, y: i64) -> [i64; 2] {
    [x, y].map(|c| (2 * c + 1) << machine.subpixel_bits)
}

fn point(v: &PortVertex) -> [i64; 2] {
    [2 * i64::from(v.x), 2 * i64::from(v.y)]
}

/// Half-open in both axes: an odd number of edges crosses the line through the centre at or left of it.
pub fn inside(machine: &Plan, triangle: &Triangle, x: i64, y: i64) -> bool {
    let p = centre(machine, x, y);
    let crossed = (0..3).filter(|&i| {
        let (a, b) = (point(&triangle[i]), point(&triangle[(i + 1) % 3]));
        let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        a[1] <= p[1] && p[1] < b[1] && right_of(a, b, p) >= 0
    });
    crossed.count() % 2 == 1
}

/// Exact value of channel `i` at a pixel's centre, as numerator and positive denominator, in LSB.
pub fn exact_value(machine: &Plan, triangle: &Triangle, i: usize, x: i64, y: i64) -> (i128, i128) {
    let p = centre(machine, x, y);
    let corner = triangle.map(|v| point(&v));
    let weight = |a: usize, b: usize| i128::from(right_of(corner[a], corner[b], p));
    let weights = [weight(1, 2), weight(2, 0), weight(0, 1)];
    let sum: i128 = weights.iter().sum();
    let moment: i128 = (0..3).map(|k| weights[k] * i128::from(triangle[k].value[i])).sum();
    (moment * sum.signum(), sum.abs() << machine.channels()[i].vertex_fraction)
}

/// Additions from the first value of a triangle to a pixel inside: lines down the major edge, then columns.
fn steps(machine: &Plan, triangle: &Triangle, x: i64, y: i64) -> f64 {
    let mut corner = triangle.map(|v| point(&v));
    corner.sort_by_key(|c| c[1]);
    let (top, bottom, p) = (corner[0], corner[2], centre(machine, x, y));
    let one = 2i64 << machine.subpixel_bits;
    let first_line = ((top[1] - one / 2).div_euclid(one)).max(-1) + 1; // at the least
    let height = (bottom[1] - top[1]) as f64;
    let columns = right_of(top, bottom, p).abs() as f64 / height / one as f64;
    (y - first_line + 1) as f64 + columns.floor()
}

/// Draws triangles and holds every fragment against the exact rule and the exact values.
pub struct Check<'a> {
    machine: &'a Plan,
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
    /// Largest |output - exact| modulo 2^b over its proved bound (A2), of all channels.
    pub of_bound: f64,
    /// Fragments of a pixel over all triangles.
    pub count: Vec<u32>,
}

impl<'a> Check<'a> {
    pub fn run(machine: &'a Plan, triangles: &'a [Triangle], stalls: Stalls) -> (Check<'a>, Frame) {
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
            of_bound: 0.0,
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
        self.arrive(fragment.source.id as usize);
        let (x, y) = place(self.machine, fragment.addr);
        let index = self.index(x, y);
        if self.seen[index] == self.current + 1 {
            self.wrong.push((self.current, x, y)); // twice
        }
        self.seen[index] = self.current + 1;
        self.count[index] += 1;
        self.fragments += 1;
        if !inside(self.machine, &self.triangles[self.current], x, y) {
            return; // close() counts it as wrong
        }
        let steps = steps(self.machine, &self.triangles[self.current], x, y);
        let output = outputs(fragment);
        for (i, output) in output.into_iter().enumerate() {
            let channel = self.machine.channels()[i];
            let (n, d) = exact_value(self.machine, &self.triangles[self.current], i, x, y);
            let difference = i128::from(output) * d - n;
            self.error[i] = self.error[i].max(difference.unsigned_abs() as f64 / d as f64);
            let turn = d << channel.bits;
            let wrapped = difference.rem_euclid(turn).min((-difference).rem_euclid(turn)) as f64 / d as f64;
            let bound = 0.5 + (1.0 + steps) * 0.5f64.powi(channel.fraction as i32 + 1);
            self.of_bound = self.of_bound.max(wrapped / bound);
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
        assert!(self.of_bound <= 1.0, "{} of the proved bound", self.of_bound);
    }

    /// What was checked, and how far off it was.
    pub fn report(&self, name: &str) {
        println!(
            "{name}: {} wrong of {} pixels; {} fragments, errors {:.3?} LSB, {:.3} of the bound",
            self.wrong.len(),
            self.pixels,
            self.fragments,
            self.error,
            self.of_bound
        );
    }
}

/// A random value for every channel.
pub fn random_values(machine: &Plan, rng: &mut impl Rng) -> [u64; 4] {
    std::array::from_fn(|i| {
        let channel = machine.channels()[i];
        rng.random_range(0..=channel.max() << channel.vertex_fraction)
    })
}

/// A random triangle around the screen whose corners lie within `size` px of each other.
pub fn random_triangle(machine: &Plan, size: f64, rng: &mut impl Rng) -> Triangle {
    let one = f64::from(1u32 << machine.subpixel_bits);
    let limit = f64::from((1u32 << machine.guard_bits) - 1);
    let middle = [machine.width, machine.height].map(|side| rng.random_range(0.0..f64::from(side)));
    std::array::from_fn(|_| {
        let c = middle.map(|m| (m + rng.random_range(-0.5..=0.5) * size).clamp(-limit, limit) * one);
        vertex(c[0].round() as i32, c[1].round() as i32, random_values(machine, rng))
    })
}

/// A machine with every key drawn at random, that can be built; `fixed` settings stay.
pub fn random_machine(fixed: &[(&str, &str)], rng: &mut impl Rng) -> Plan {
    use edgewalk_machine::keys::{Domain, KEYS};
    loop {
        let mut machine = Machine::default();
        for key in KEYS {
            let value = match key.domain {
                Domain::Range(low, high) => rng.random_range(low..=high),
                Domain::OneOf(list) => list[rng.random_range(0..list.len())],
                Domain::Word(words) => rng.random_range(0..words.len() as u32),
            };
            (key.set)(&mut machine, value);
        }
        for (key, value) in fixed {
            machine.set(key, value).expect("a key of the machine");
        }
        if let Ok(plan) = machine.plan() {
            return plan;
        }
    }
}

/// A cycle of a machine with its memory.
pub struct Cycle<'a> {
    /// Number of the cycle, from 0.
    pub now: u64,
    pub outputs: &'a Outputs,
    /// A triangle was taken.
    pub triangle: bool,
    /// The fragment whose read fired.
    pub read: Option<Fragment>,
    /// The write that fired.
    pub write: Option<Write>,
}

/// Draws triangles and shows every cycle; `writes_open` says in which cycles the memory takes writes at all.
pub fn drive(
    machine: &Plan,
    triangles: &[Triangle],
    state: DrawState,
    stalls: Stalls,
    writes_open: impl Fn(u64) -> bool,
    mut watch: impl FnMut(&Cycle),
) -> (Model, Memory) {
    let mut model = Model::new(machine);
    let mut memory = Memory::new(machine, state.clear, stalls);
    let mut next = 0;
    for now in 0.. {
        let inputs = Inputs {
            rst: false,
            tri: triangles.get(next).map(|t| (t, 0)),
            depth_func: state.depth_func,
            depth_write: state.depth_write,
            rd_ready: memory.rd_ready(),
            data: memory.data(),
            wr_ready: memory.wr_ready() && writes_open(now),
        };
        let outputs = model.cycle(&inputs);
        let read = outputs.rd.filter(|_| inputs.rd_ready);
        let write = outputs.wr.filter(|_| inputs.wr_ready);
        let triangle = outputs.tri_ready && inputs.tri.is_some();
        watch(&Cycle { now, outputs: &outputs, triangle, read: read.map(|_| model.last_read()), write });
        memory.step(read, inputs.data.is_some() && outputs.data_ready, write.as_ref());
        next += usize::from(triangle);
        if outputs.idle && next == triangles.len() && !triangle {
            break;
        }
    }
    (model, memory)
}

/// The depth test one fragment after the other: what is stored in the end, and what was written.
pub struct Sequential {
    pub stored: HashMap<u32, (u32, [u16; 3])>,
    pub writes: Vec<Write>,
}

pub fn sequential(machine: &Plan, fragments: &[Fragment], state: DrawState) -> Sequential {
    let empty = (machine.z.max() as u32, state.clear.map(|c| c as u16));
    let mut stored = HashMap::new();
    let mut writes = Vec::new();
    for f in fragments {
        let (z, rgb) = stored.entry(f.addr).or_insert(empty);
        let passes = match state.depth_func {
            0 => false,
            1 => f.z < *z,
            2 => f.z == *z,
            3 => f.z <= *z,
            4 => f.z > *z,
            5 => f.z != *z,
            6 => f.z >= *z,
            _ => true,
        };
        if passes {
            *rgb = f.rgb.channels();
            if state.depth_write {
                *z = f.z;
            }
            let z_en = state.depth_write;
            writes.push(Write { addr: f.addr, z: f.z, z_en, rgb: f.rgb, source: f.source });
        }
    }
    Sequential { stored, writes }
}
