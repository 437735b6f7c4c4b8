//! The intensity along a line of a picture, and how its slope jumps at the edges of triangles.

use crate::exhibit::{HEIGHT, LSB, WIDTH};
use crate::plot::Series;
use edgewalk_golden::Picture;

/// Intensity along the middle line, from pixel to pixel.
pub(crate) struct Profile {
    /// Mean of the three colours, LSB of 8 bits.
    values: Vec<f64>,
    /// The triangle seen, negative for none.
    id: Vec<i32>,
}

impl Profile {
    pub fn of(picture: &Picture) -> Self {
        let line = (HEIGHT / 2 * WIDTH) as usize..(HEIGHT / 2 * WIDTH + WIDTH) as usize;
        let grey = |rgb: &[f64; 3]| rgb.iter().sum::<f64>() / 3.0 * LSB;
        Self { values: picture.rgb[line.clone()].iter().map(grey).collect(), id: picture.id[line].to_vec() }
    }

    /// As a line of a plot.
    pub fn series(&self, label: &'static str) -> Series {
        let shown = (0..self.id.len()).filter(|x| self.id[*x] >= 0);
        Series { label, points: shown.map(|x| (x as f64, self.values[x])).collect() }
    }

    /// The slope from pixel to pixel as a line of a plot.
    pub fn slope_series(&self, label: &'static str) -> Series {
        let shown = (1..self.id.len()).filter(|x| self.id[*x] >= 0 && self.id[*x - 1] >= 0);
        Series { label, points: shown.map(|x| (x as f64, self.values[x] - self.values[x - 1])).collect() }
    }

    /// Largest step of the intensity from one triangle to its neighbour, LSB.
    pub fn largest_step(&self) -> f64 {
        self.borders().map(|x| (self.values[x] - self.values[x - 1]).abs()).fold(0.0, f64::max)
    }

    /// Largest change of the slope where one triangle meets the next, LSB/px; and inside a triangle.
    pub fn slope_jumps(&self) -> [f64; 2] {
        let slope = |x: usize| self.values[x] - self.values[x - 1];
        let alone = |from: usize, to: usize| (from..to).all(|x| self.id[x] == self.id[from]);
        // Two pixels of each triangle at the border say what its slope is.
        let meets = self.borders().filter(|x| *x >= 2 && alone(x - 2, *x) && alone(*x, (x + 2).min(self.id.len())));
        let at_edges = meets.filter(|x| x + 1 < self.id.len()).map(|x| (slope(x + 1) - slope(x - 1)).abs());
        let whole = (2..self.id.len()).filter(|x| self.id[*x] >= 0 && alone(x - 2, x + 1));
        let inside = whole.map(|x| (slope(x) - slope(x - 1)).abs());
        [at_edges.fold(0.0, f64::max), inside.fold(0.0, f64::max)]
    }

    /// Pixels that begin another triangle than the one before them.
    fn borders(&self) -> impl Iterator<Item = usize> + '_ {
        (1..self.id.len()).filter(|x| self.id[*x] >= 0 && self.id[*x - 1] >= 0 && self.id[*x] != self.id[*x - 1])
    }
}
