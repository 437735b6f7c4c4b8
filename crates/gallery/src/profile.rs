//! The intensity along a line of a picture, and how its slope jumps at the edges of triangles.

use crate::exhibit::{HEIGHT, LSB, WIDTH};
use crate::plot::Series;
use edgewalk_golden::Picture;

/// Deviations of the near and the far surroundings of the filter, pixels.
const NEAR: f64 = 2.0;
const FAR: f64 = 8.0;

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

    /// The line as an eye perceives it, by a centre-surround filter: to each intensity comes what its near surroundings are above its far
    /// ones (Gaussians of 2 and 8 pixels, where something is seen). Lateral inhibition makes bright and dark lines of a step or a bend.
    pub fn perceived(&self, label: &'static str) -> Series {
        let mean = |x: usize, sigma: f64| {
            let (mut sum, mut weights) = (0.0, 0.0);
            for (place, value) in self.values.iter().enumerate().filter(|(place, _)| self.id[*place] >= 0) {
                let weight = (-0.5 * ((place as f64 - x as f64) / sigma).powi(2)).exp();
                (sum, weights) = (sum + weight * value, weights + weight);
            }
            sum / weights
        };
        let shown = (0..self.id.len()).filter(|x| self.id[*x] >= 0);
        let response = |x: usize| self.values[x] + mean(x, NEAR) - mean(x, FAR);
        Series { label, points: shown.map(|x| (x as f64, response(x))).collect() }
    }

    /// Most that an eye perceives beyond the intensity where triangles meet, far from the ends of what is seen, LSB.
    pub fn largest_response(&self) -> f64 {
        let (actual, perceived) = (self.series("").points, self.perceived("").points);
        let margin = (3.0 * FAR) as usize;
        let inner = actual.iter().zip(&perceived).skip(margin).take(actual.len().saturating_sub(2 * margin));
        inner.map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max)
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

    /// Of a line without bends nothing is added; beside a step the dark side is perceived darker, the bright one brighter.
    #[test]
    fn an_eye_perceives_bands_beside_a_step() {
        let line =
            |value: fn(usize) -> f64| Profile { values: (0..200).map(value).collect(), id: vec![0; 200] };
        let ramp = line(|x| x as f64);
        let (shown, seen) = (ramp.series(""), ramp.perceived(""));
        let off = shown.points[60..140].iter().zip(&seen.points[60..140]);
        assert!(off.map(|(a, b)| (a.1 - b.1).abs()).fold(0.0, f64::max) < 1e-6);
        let step = line(|x| if x < 100 { 50.0 } else { 150.0 });
        let perceived = step.perceived("").points;
        assert!(perceived[96].1 < 40.0 && perceived[103].1 > 160.0 && (perceived[50].1 - 50.0).abs() < 0.1);
        assert!(step.largest_response() > 10.0);
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
