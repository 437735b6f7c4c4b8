//! The errors of depth and colour, their bounds, and which outputs wrapped.

use crate::engine::Raster;
use edgewalk_machine::{Channel, ErrorBudget, NoBound, Plan};

/// Errors found so far, depth and colour.
pub struct Tally<'a> {
    drawn: &'a Raster,
    /// Depth.
    pub z: Errors,
    /// Colour, the worst of three.
    pub color: Errors,
    /// Pixels where either wrapped.
    pub wrapped: u64,
}

/// Errors of a channel found so far, LSB.
pub struct Errors {
    channel: Channel,
    budget: Result<ErrorBudget, NoBound>,
    largest: f64,
    map: Vec<f64>,
}

impl<'a> Tally<'a> {
    /// Nothing found yet.
    pub fn new(machine: &Plan, golden: &Raster, drawn: &'a Raster) -> Self {
        let errors = |channel| Errors {
            channel,
            budget: machine.proved_budget(&channel),
            largest: 0.0,
            map: vec![0.0; golden.coverage.len()],
        };
        Tally { drawn, z: errors(machine.channels()[0]), color: errors(machine.channels()[1]), wrapped: 0 }
    }

    /// Pixel `i` shows a triangle whose exact depth and colour there, in [0,1], are these.
    pub fn triangle(&mut self, i: usize, z: f64, rgb: [f64; 3]) {
        let mut wrapped = self.z.add(i, z, self.drawn.z[i]);
        for (exact, drawn) in rgb.into_iter().zip(self.drawn.rgb[i]) {
            wrapped |= self.color.add(i, exact, drawn);
        }
        self.wrapped += u64::from(wrapped);
    }

    /// Whether pixel `i` has the cleared depth and, to the nearest LSB, the cleared colour.
    pub fn is_background(&self, i: usize, clear: [f64; 3]) -> bool {
        let half = 0.5 + 1e-9; // the division by 2^b - 1 rounds
        let near =
            |(exact, drawn): (f64, f64)| (exact - drawn).abs() * self.color.channel.max() as f64 <= half;
        self.drawn.z[i] == 1.0 && clear.into_iter().zip(self.drawn.rgb[i]).all(near)
    }
}

impl Errors {
    /// Takes in a value that should be `exact`, both in [0,1]; returns whether it wrapped.
    fn add(&mut self, i: usize, exact: f64, drawn: f64) -> bool {
        let error = (drawn - exact).abs() * self.channel.max() as f64;
        self.largest = worse(self.largest, error);
        self.map[i] = worse(self.map[i], error);
        // An output that stayed in its range is nearer to the exact value than half the range, one that wrapped is not.
        error > 0.5 * (self.channel.max() + 1) as f64
    }

    /// Proved largest error of the output: vertex rounding, all additions, output rounding (A2, A4).
    pub fn bound(&self) -> Option<f64> {
        self.budget.map(|budget| budget.after_rounding().to_f64()).ok()
    }

    /// Why there is none.
    pub fn no_bound(&self) -> Option<String> {
        self.budget.err().map(|why| why.to_string())
    }

    /// The largest error, and that of every pixel.
    pub fn found(self) -> (f64, Vec<f64>) {
        (self.largest, self.map)
    }
}

/// The larger of two errors; NaN is the largest.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
