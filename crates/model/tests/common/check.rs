//! A machine's fragments against the exact rule and the exact values.

use super::rule::{exact_value, inside, steps};
use super::{ALWAYS, Triangle, is_divided, outputs, place};
use edgewalk_machine::{Channel, Kind, Plan};
use edgewalk_model::{Drawn, Frame, Sample, Stalls, render_with};

/// What a channel's outputs have shown, all |output - exact value of the vertices at the port|.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    /// Outputs compared.
    pub checked: u64,
    /// Those for which a bound holds; the others are compared modulo 2^b.
    pub bounded: u64,
    /// The largest, LSB.
    pub largest: f64,
    /// The largest over its proved bound, where that holds.
    pub of_bound: f64,
    /// Those beyond: values, and where.
    pub beyond: Vec<String>,
}

/// Draws triangles and holds every fragment against the exact rule and the exact values.
pub struct Check<'a> {
    plan: &'a Plan,
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
    /// By channel.
    pub errors: Vec<Errors>,
    /// Fragments of a pixel over all triangles.
    pub count: Vec<u32>,
}

impl<'a> Check<'a> {
    pub fn run(plan: &'a Plan, triangles: &'a [Triangle], stalls: Stalls) -> (Check<'a>, Frame) {
        let pixels = (plan.width * plan.height) as usize;
        let mut check = Check {
            plan,
            triangles,
            seen: vec![0; pixels],
            current: 0,
            pixels: 0,
            fragments: 0,
            wrong: Vec::new(),
            errors: vec![Errors::default(); plan.channels().len()],
            count: vec![0; pixels],
        };
        let hook = |drawn: Drawn| {
            if let Drawn::Fragment(sample) = drawn {
                check.fragment(&sample);
            }
        };
        let frame = render_with(plan, triangles.iter().copied(), ALWAYS, stalls, hook);
        check.arrive(triangles.len());
        (check, frame.expect("this machine's vertices"))
    }

    fn index(&self, x: i64, y: i64) -> usize {
        (y * i64::from(self.plan.width) + x) as usize
    }

    fn fragment(&mut self, sample: &Sample) {
        self.arrive(sample.source.id as usize);
        let (x, y) = place(self.plan, sample.addr);
        let index = self.index(x, y);
        if self.seen[index] == self.current + 1 {
            self.wrong.push((self.current, x, y)); // twice
        }
        self.seen[index] = self.current + 1;
        self.count[index] += 1;
        self.fragments += 1;
        let triangle = &self.triangles[self.current];
        if !inside(self.plan, triangle, x, y) {
            return; // close() counts it as wrong
        }
        let steps = steps(self.plan, triangle, x, y);
        let outputs = outputs(self.plan, sample.values);
        for (i, (channel, output)) in self.plan.channels().iter().zip(outputs).enumerate() {
            if is_divided(self.plan, channel) {
                continue;
            }
            let exact = exact_value(self.plan, triangle, i, x, y);
            let total = i128::from(steps.total());
            let holds = channel.error_budget(steps).holds();
            self.errors[i].compare(channel, output, exact, total, holds, || {
                format!("{} of {output} at ({x}, {y}) of {triangle:?}", channel.name)
            });
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
        let s = self.plan.subpixel_bits;
        let range = |c: [i32; 3], side: u32| {
            let (low, high) = (c.into_iter().min().unwrap_or(0) >> s, c.into_iter().max().unwrap_or(0) >> s);
            (i64::from(low) - 1).max(0)..=(i64::from(high) + 1).min(i64::from(side) - 1)
        };
        for y in range(triangle.map(|v| v.y()), self.plan.height) {
            for x in range(triangle.map(|v| v.x()), self.plan.width) {
                self.pixels += 1;
                let drawn = self.seen[self.index(x, y)] == self.current + 1;
                if drawn != inside(self.plan, triangle, x, y) {
                    self.wrong.push((self.current, x, y));
                }
            }
        }
    }

    /// The values lie within their proved bounds.
    pub fn within_bounds(&self) {
        for errors in &self.errors {
            assert!(errors.beyond.is_empty(), "beyond the bound: {} in {:?}", errors.beyond[0], self.plan);
        }
    }

    /// Coverage equal everywhere, and what README promises of the default machine: z and colour within 1 LSB of the exact
    /// value.
    pub fn passes(&self) {
        assert!(self.pixels > 0 && self.fragments > 0, "nothing was checked");
        if let Some((number, x, y)) = self.wrong.first() {
            panic!("pixel ({x}, {y}) of triangle {number}: {:?}", self.triangles[*number]);
        }
        self.within_bounds();
        for (errors, channel) in self.errors.iter().zip(self.plan.channels()) {
            assert!(errors.largest <= 1.0, "{} is {} LSB off", channel.name, errors.largest);
        }
    }

    /// What was checked, and how far off it was.
    pub fn report(&self, name: &str) {
        let list = |of: fn(&Errors) -> f64| self.errors.iter().map(of).collect::<Vec<_>>();
        println!(
            "{name}: {} wrong of {} pixels; {} fragments, errors {:.3?} LSB, {:.3?} of the bound",
            self.wrong.len(),
            self.pixels,
            self.fragments,
            list(|e| e.largest),
            list(|e| e.of_bound)
        );
    }
}

impl Errors {
    /// Compares an output with the exact value n/d behind so many additions. All in integers: the error times 2·2^r, and the
    /// bound (bound 2) of 1 + `steps` roundings, with the rounding of the output.
    fn compare(
        &mut self,
        channel: &Channel,
        output: i64,
        (n, d): (i128, i128),
        steps: i128,
        holds: bool,
        place: impl Fn() -> String,
    ) {
        let turn = d << channel.bits;
        let mut error = i128::from(output) * d - n;
        if !holds {
            error = (error + turn / 2).rem_euclid(turn) - turn / 2;
        }
        let one = 2i128 << channel.fraction;
        // How far the output may lie above and below.
        let (above, below) = match channel.kind {
            Kind::Unorm | Kind::Signed | Kind::Weight => (one / 2 + 1 + steps, one / 2 + 1 + steps),
            Kind::Floor => (1 + steps, one + 1 + steps),
        };
        self.checked += 1;
        self.largest = self.largest.max(error.unsigned_abs() as f64 / d as f64);
        if holds {
            self.bounded += 1;
            let allowed = if error > 0 { above } else { below };
            self.of_bound = self.of_bound.max((error * one).unsigned_abs() as f64 / (d * allowed) as f64);
        }
        if error * one > above * d || -error * one > below * d {
            self.beyond.push(place());
        }
    }
}
