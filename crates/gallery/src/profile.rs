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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exhibit::FILL;
    use edgewalk_golden::draw;
    use edgewalk_scene::Frame;

    /// Of the greys below.
    const STEP: f64 = LSB / 16.0;

    /// Two triangles of four pixels and one of one, in the middle line; in the lines beside it another one.
    fn profile() -> Profile {
        let mut picture = draw(&Frame::new(WIDTH, HEIGHT), FILL);
        let place = |line: u32| (line * WIDTH) as usize..((line + 1) * WIDTH) as usize;
        for line in [HEIGHT / 2 - 1, HEIGHT / 2 + 1] {
            picture.rgb[place(line)].fill([1.0; 3]);
            picture.id[place(line)].fill(5);
        }
        let first = place(HEIGHT / 2).start + 100;
        let line = [(7, 2), (7, 3), (7, 4), (7, 5), (9, 8), (9, 7), (9, 5), (9, 0), (3, 1)];
        for (k, (id, grey)) in line.into_iter().enumerate() {
            // Colours that have this mean, and are exact.
            picture.rgb[first + k] = [0, 1, -1].map(|off| f64::from(grey + off) / 16.0);
            picture.id[first + k] = id;
        }
        Profile::of(&picture)
    }

    #[test]
    fn a_line_of_a_plot_is_the_mean_of_the_colours_where_something_is_seen() {
        let shown = |first: u32, values: &[f64]| -> Vec<(f64, f64)> {
            (first..).zip(values).map(|(x, value)| (f64::from(x), value * STEP)).collect()
        };
        let (profile, greys) = (profile(), [2.0, 3.0, 4.0, 5.0, 8.0, 7.0, 5.0, 0.0, 1.0]);
        assert_eq!(profile.series("grey").points, shown(100, &greys));
        let slopes = [1.0, 1.0, 1.0, 3.0, -1.0, -2.0, -5.0, 1.0];
        assert_eq!(profile.slope_series("slope").points, shown(101, &slopes));
    }

    #[test]
    fn steps_lie_between_triangles_and_bends_inside_one() {
        let profile = profile();
        assert_eq!(profile.largest_step(), 3.0 * STEP);
        // From 1 to -1; one pixel alone has no slope.
        assert_eq!(profile.slope_jumps(), [2.0 * STEP]);
        assert_eq!(profile.largest_bend(), 3.0 * STEP, "from -2 to -5");
    }
}
