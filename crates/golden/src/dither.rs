//! Fewer bits a colour: rounded to the nearest, or by an ordered pattern; and a screen door, the pattern by which a share of the pixels
//! of a surface is left out (the "pixel level tricks" of ch. 7.4).
//!
//! ```text
//!   nearest   the step that is nearest: a ramp becomes bands, and where two meet the eye sees an edge
//!   ordered   the step below or above, so that the mean of 4 x 4 pixels is the colour to a sixteenth of a step
//! ```

/// Bayer's pattern of 4 x 4 pixels: each number from 0 to 15 once, neighbours as far apart as can be.
const PATTERN: [[u32; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The pattern's number at a pixel, column and line.
pub fn pattern(x: u32, y: u32) -> u32 {
    PATTERN[y as usize % 4][x as usize % 4]
}

/// Whether a surface of this k_t, 0 to 1, is left out at a pixel of a screen door.
pub fn left_out(kt: f64, x: u32, y: u32) -> bool {
    f64::from(pattern(x, y)) < 16.0 * kt
}

/// How colours lose bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dither {
    /// Bits b of a colour, 1 to 16.
    pub bits: u32,
    /// Bits n that are left, 1 to b.
    pub left: u32,
}

impl Dither {
    /// The step that a colour of b bits becomes at a pixel: as a part of 2^b it is brought to the same part of 2^n, and the pattern decides
    /// between the two steps beside it.
    pub fn ordered(self, color: u64, x: u32, y: u32) -> u64 {
        let (cut, part) = (1u64 << (self.bits - self.left), color / (1 << self.left));
        (color - part + u64::from(pattern(x, y)) * cut / 16) / cut
    }

    /// The step that is nearest to a colour from 0 to 1.
    pub fn nearest(self, color: f64) -> u64 {
        (color * self.most()).round_ties_even() as u64
    }

    /// A step as a colour from 0 to 1.
    pub fn color(self, step: u64) -> f64 {
        step as f64 / self.most()
    }

    /// The colour of b bits that is nearest to one from 0 to 1.
    pub fn whole(self, color: f64) -> u64 {
        (color * ((1u64 << self.bits) - 1) as f64).round_ties_even() as u64
    }

    /// Whether a step may be shown at a pixel whose colour of b bits lies so far around this one, both in LSB. A brighter colour never
    /// becomes a darker step, so the ends of that range decide.
    pub fn explains(self, step: u64, color: f64, error: f64, [x, y]: [u32; 2]) -> bool {
        let most = ((1u64 << self.bits) - 1) as f64;
        let [low, high] =
            [(color - error).ceil(), (color + error).floor()].map(|end| end.clamp(0.0, most) as u64);
        (self.ordered(low, x, y)..=self.ordered(high, x, y)).contains(&step)
    }

    /// The largest step, which stands for 1.
    fn most(self) -> f64 {
        ((1u64 << self.left) - 1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every colour at every place, for each number of bits that a machine may have: 45 pairs of b and n.
    #[test]
    fn every_step_is_less_than_one_off() {
        let mut checked = 0;
        for bits in 5..=16u32 {
            for left in 4..bits.min(8) {
                let dither = Dither { bits, left };
                let (most, step) = ((1u64 << bits) - 1, 1.0 / dither.most());
                for color in 0..=most {
                    let exact = color as f64 / most as f64;
                    let mut sum = 0;
                    for place in 0..16 {
                        let shown = dither.ordered(color, place % 4, place / 4);
                        assert!(shown <= dither.most() as u64, "{bits} to {left}: {color} at {place}");
                        let off = dither.color(shown) - exact;
                        assert!(off.abs() < step, "{bits} to {left}: {color} at {place} is off by {off}");
                        sum += shown;
                        checked += 1;
                    }
                    // The mean is the colour to a sixteenth of a step and the part that is brought down.
                    let mean = dither.color(sum) / 16.0 - exact;
                    let below = (1.0 / 16.0 + 1.0 / f64::from(1u32 << (bits - left))) * step;
                    assert!(
                        (-below - 1e-12..=below + 1e-12).contains(&mean),
                        "{bits} to {left}: {color}: {mean}"
                    );
                }
                assert_eq!([dither.ordered(0, 3, 0), dither.ordered(most, 0, 0)], [0, dither.most() as u64]);
            }
        }
        println!("{checked} colours");
        assert!(checked > 1_000_000);
    }

    #[test]
    fn a_screen_door_leaves_out_its_share() {
        for sixteenths in 0..=16u32 {
            let kt = f64::from(sixteenths) / 16.0;
            let out = (0..64u32).filter(|at| left_out(kt, at % 8, at / 8)).count();
            assert_eq!(out as u32, 4 * sixteenths);
        }
    }

    #[test]
    fn steps_outside_the_error_are_not_explained() {
        let dither = Dither { bits: 8, left: 5 };
        let shown = dither.ordered(100, 1, 2);
        assert!(dither.explains(shown, 100.3, 0.5, [1, 2]));
        assert!(
            !dither.explains(shown + 1, 100.3, 0.5, [1, 2])
                && !dither.explains(shown - 1, 100.3, 0.5, [1, 2])
        );
    }
}
