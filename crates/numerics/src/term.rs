//! Terms: quadratics and planes over the screen, in words of w bits that only additions follow.
//!
//! ```text
//!   f over the triangle ──exact fit──> six numbers at a pixel ──RN, once──> words ──moved, no rounding──> words at the port
//! ```
//! Of a quadratic f, i columns along the span and n lines down from a pixel, its value there is `V + i X + n
//! Y + i(i-1)/2 XX + n(n-1)/2 YY + i n XY`, in words modulo 2^w: derivation and bound 12 in
//! `docs/numerics.md`.

mod fit;
mod words;

pub use fit::{NODE_BITS, Shares, node};
pub use words::{MAX_TERM_BITS, TermWords};

/// Highest power of x and y in a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Degree {
    /// V, X and Y; the second differences are 0.
    Linear,
    /// All six.
    Quadratic,
}

/// Roundings in a word i columns and n lines from where it was rounded, each of at most half a unit u, so
/// that it is off by at most `roundings · u/2` (bound 12): `1 + |i| + |n|`, and of a quadratic `|i(i-1)/2| +
/// |n(n-1)/2| + |i n|` more.
#[must_use]
pub fn term_roundings(degree: Degree, i: i64, n: i64) -> u128 {
    let (columns, lines) = (i128::from(i), i128::from(n));
    let second = match degree {
        Degree::Linear => 0,
        Degree::Quadratic => {
            (columns * (columns - 1) / 2).abs() + (lines * (lines - 1) / 2).abs() + (columns * lines).abs()
        }
    };
    // Of i64 the products stay below 2^127.
    (1 + columns.abs() + lines.abs() + second).unsigned_abs()
}

/// The most roundings at a pixel of a box of so many pixels, rounded in its middle.
#[must_use]
pub fn term_roundings_of_box(degree: Degree, width: u32, height: u32) -> u128 {
    // Of an even number of pixels one more lies before the middle than behind it.
    let before = |pixels: u32| -i64::from(pixels / 2);
    term_roundings(degree, before(width), before(height))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_the_roundings_of_its_corner() {
        for (width, height, roundings) in [
            (32, 32, 561),
            (64, 64, 2145),
            (128, 128, 8385),
            (256, 256, 33153),
            (512, 512, 131_841),
            (640, 480, 157_641),
            (1280, 960, 628_881),
            (1, 1, 1),
        ] {
            assert_eq!(term_roundings_of_box(Degree::Quadratic, width, height), roundings);
            let middle = (i64::from(width / 2), i64::from(height / 2));
            let corners = [(0, 0), (i64::from(width) - 1, 0), (0, i64::from(height) - 1)];
            let at = |(x, y): (i64, i64)| term_roundings(Degree::Quadratic, x - middle.0, y - middle.1);
            assert!(corners.into_iter().all(|corner| at(corner) <= roundings));
        }
        assert_eq!(term_roundings_of_box(Degree::Linear, 640, 480), 561);
    }
}
