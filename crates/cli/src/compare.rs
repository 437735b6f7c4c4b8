//! A machine's picture against the golden one.

use crate::engine::Raster;
use crate::verdict::Verdict;
use edgewalk_machine::{Channel, Plan};
use serde::Serialize;

/// What the comparison found. Errors are against the exact plane through the unquantised vertices.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Pixels whose coverage was compared.
    pub pixels: u64,
    /// Pixels where another number of triangles covers.
    pub coverage_mismatches: u64,
    /// Pixels whose depth and colour were compared: the same triangle is visible in both.
    pub shaded: u64,
    /// Pixels where the two pictures show different triangles whose depths differ by no more than the bound allows (A7).
    pub order_undecided: u64,
    /// Pixels where they differ by more.
    pub order_wrong: u64,
    /// Largest depth error, LSB.
    pub z_error: f64,
    /// Largest colour error, LSB.
    pub color_error: f64,
    /// Proved bound of the depth error, LSB.
    pub z_bound: f64,
    /// Proved bound of the colour error, LSB.
    pub color_bound: f64,
    /// Depth error of every pixel, LSB.
    #[serde(skip)]
    pub z_map: Vec<f64>,
    /// Largest colour error of every pixel, LSB.
    #[serde(skip)]
    pub color_map: Vec<f64>,
}

/// Compares pixel by pixel.
pub fn compare(machine: &Plan, golden: &Raster, drawn: &Raster) -> Comparison {
    let (z_max, color_max) = (machine.z.max() as f64, machine.color.max() as f64);
    let (z_bound, color_bound) = bounds(machine);
    let count = golden.coverage.len();
    let mut c = Comparison {
        pixels: count as u64,
        coverage_mismatches: 0,
        shaded: 0,
        order_undecided: 0,
        order_wrong: 0,
        z_error: 0.0,
        color_error: 0.0,
        z_bound,
        color_bound,
        z_map: vec![0.0; count],
        color_map: vec![0.0; count],
    };
    for i in 0..count {
        c.coverage_mismatches += u64::from(golden.coverage[i] != drawn.coverage[i]);
        let z = (golden.z[i] - drawn.z[i]).abs() * z_max;
        if golden.id[i] != drawn.id[i] {
            // Both depths carry at most the bound, so farther apart than twice that the order is wrong (A7).
            if z <= 2.0 * z_bound {
                c.order_undecided += 1
            } else {
                c.order_wrong += 1
            }
            continue;
        }
        if golden.id[i] < 0 {
            continue;
        }
        let color =
            (0..3).map(|k| (golden.rgb[i][k] - drawn.rgb[i][k]).abs() * color_max).fold(0.0, f64::max);
        c.shaded += 1;
        c.z_error = c.z_error.max(z);
        c.color_error = c.color_error.max(color);
        c.z_map[i] = z;
        c.color_map[i] = color;
    }
    c
}

impl Comparison {
    /// Pass only if every coverage agrees, every error is within its bound, and no order is wrong.
    pub fn verdict(&self) -> Verdict {
        let wrong = self.coverage_mismatches
            + self.order_wrong
            + u64::from(self.z_error > self.z_bound)
            + u64::from(self.color_error > self.color_bound);
        Verdict::of(self.pixels, self.pixels, wrong)
    }
}

/// Proved bounds of the rounded output of depth and colour, LSB: vertex rounding, all additions, output rounding (A2, A4).
fn bounds(machine: &Plan) -> (f64, f64) {
    let steps = machine.max_steps();
    let bound = |channel: &Channel| channel.error_budget(steps).after_rounding().to_f64();
    (bound(&machine.channels()[0]), bound(&machine.channels()[1]))
}
