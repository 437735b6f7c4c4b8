//! Where vertices may lie and where pixels have their centres.
//!
//! Units: half sub-pixels, so that pixel centres are integers even without sub-pixel bits; coordinates stay below
//! 10^6 * 2^8 * 2 < 2^29.

use crate::cover::snap;
use edgewalk_scene::Vertex;

/// A raster of pixels, and the finer one of the vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid {
    subpixel_bits: u32,
    /// Of pixel (0, 0), either axis.
    centre: i64,
}

impl Grid {
    /// Vertices on 2^-`subpixel_bits` of a pixel, 0..=[`crate::MAX_SUBPIXEL_BITS`] bits; pixel i has its centre at
    /// i + 1/2.
    pub fn subpixels(subpixel_bits: u32) -> Self {
        Self { subpixel_bits, centre: 1 << subpixel_bits }
    }

    /// Whole vertices, and pixel i at the coordinate i ("pixels are at integer values", the slides).
    pub fn whole() -> Self {
        Self { subpixel_bits: 0, centre: 0 }
    }

    /// A vertex's place, the nearest sub-pixel, half to even.
    pub(crate) fn place(self, vertex: &Vertex) -> [i64; 2] {
        [vertex.x, vertex.y].map(|coordinate| 2 * snap(coordinate, self.subpixel_bits))
    }

    /// The distance of two pixels, at most 2^9.
    pub(super) fn pitch(self) -> i64 {
        2 << self.subpixel_bits
    }

    /// The centre of a pixel, either axis.
    pub(crate) fn centre(self, pixel: i64) -> i64 {
        self.pitch() * pixel + self.centre
    }

    /// The first pixel whose centre is not before `place`, either axis: rounded up.
    pub(crate) fn first_pixel(self, place: i64) -> i64 {
        -(self.centre - place).div_euclid(self.pitch())
    }

    /// The pixel that holds the quotient, or ends there: on the border of two pixels the one before. The numerator is below 2^61, the
    /// denominator below 2^30.
    pub(crate) fn pixel_before_quotient(self, numerator: i64, denominator: i64) -> i64 {
        let edge = self.centre - self.pitch() / 2;
        -(edge * denominator - numerator).div_euclid(self.pitch() * denominator) - 1
    }

    /// In pixels, exact.
    pub(crate) fn pixels(self, distance: i64) -> f64 {
        distance as f64 / self.pitch() as f64
    }
}
