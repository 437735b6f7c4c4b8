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
        Series { label, points: shown.map(|x| (x as f64, self.slope(x))).collect() }
    }

    /// Largest step of the intensity from one triangle to its neighbour, LSB.
    pub fn largest_step(&self) -> f64 {
        self.borders().map(|x| (self.values[x] - self.values[x - 1]).abs()).fold(0.0, f64::max)
    }

    /// How much the slope changes at each place where one triangle meets the next, LSB/px.
    pub fn slope_jumps(&self) -> Vec<f64> {
        // Two pixels of each triangle at the border say what its slope is.
        let meets = self.borders().filter(|x| self.is_one(*x - 2, *x) && self.is_one(*x, *x + 2));
        meets.map(|x| (self.slope(x + 1) - self.slope(x - 1)).abs()).collect()
    }

    /// Largest change of the slope from pixel to pixel inside a triangle, LSB/px.
    pub fn largest_bend(&self) -> f64 {
        let inside = (2..self.id.len()).filter(|x| self.id[*x] >= 0 && self.is_one(*x - 2, *x + 1));
        inside.map(|x| (self.slope(x) - self.slope(x - 1)).abs()).fold(0.0, f64::max)
    }

    /// From the pixel before.
    fn slope(&self, x: usize) -> f64 {
        self.values[x] - self.values[x - 1]
    }

    /// Whether pixels show one triangle; none beyond the line does.
    fn is_one(&self, from: usize, to: usize) -> bool {
        self.id.get(from..to).is_some_and(|ids| ids.iter().all(|id| *id == ids[0]))
    }

    /// Pixels that begin another triangle than the one before them.
    fn borders(&self) -> impl Iterator<Item = usize> + '_ {
        (2..self.id.len())
            .filter(|x| self.id[*x] >= 0 && self.id[*x - 1] >= 0 && self.id[*x] != self.id[*x - 1])
    }
}
