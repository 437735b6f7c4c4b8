//! A pixel of a triangle or polygon: how much each vertex weighs there, and so depth and colour.
//!
//! The weights are exact integers, so slivers lose nothing. A value is (w0 a0 + w1 a1 + ..) / (w0 + w1 + ..): where no
//! weight is negative nothing cancels, and with u = 2^-53 a weight, a product, at most three sums, the total and the
//! quotient round once each: relative error below 7.01 u. [`Fragment::UNCERTAINTY`] is that bound with something to spare.

use edgewalk_scene::Vertex;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{AsPrimitive, Float};
use std::cmp::Ordering;

/// A whole number of which one vertex weighs more than another.
pub trait Weight: AsPrimitive<f64> + Into<BigInt> {}

impl Weight for i64 {}
impl Weight for i128 {}

/// A pixel of a triangle, or with other parameters of a polygon: a mean of N vertices.
#[derive(Debug, Clone)]
pub struct Fragment<'a, const N: usize = 3, W = i64> {
    /// Column, pixels from the left of the screen.
    pub x: u32,
    /// Row, pixels from the top of the screen.
    pub y: u32,
    /// The triangle, or the ends of two edges; in flat mode all have the first one's colour.
    pub(crate) vertices: &'a [Vertex; N],
    /// What each vertex weighs.
    pub(crate) weights: [W; N],
    /// Sum of the weights, positive.
    pub(crate) total: W,
}

impl Fragment<'_> {
    /// Relative error of every value inside a triangle or polygon is below this.
    pub const UNCERTAINTY: f64 = 8.0 / (1u64 << 53) as f64;
}

impl<const N: usize, W: Weight> Fragment<'_, N, W> {
    /// Depth, in [0, 1] inside the triangle.
    pub fn z(&self) -> f64 {
        self.value(|vertex| vertex.z)
    }

    /// Red, green, blue, in [0, 1] each inside the triangle.
    pub fn rgb(&self) -> [f64; 3] {
        [self.value(|vertex| vertex.r), self.value(|vertex| vertex.g), self.value(|vertex| vertex.b)]
    }

    /// Transmission coefficient k_t, in [0, 1] inside the triangle.
    pub fn kt(&self) -> f64 {
        self.value(|vertex| vertex.kt)
    }

    /// The value of the user's own channel with this number. Terms of both signs may cancel, so its error is relative to
    /// the largest magnitude of a vertex.
    pub fn extra(&self, channel: usize) -> f64 {
        self.value(|vertex| vertex.extra[channel])
    }

    /// The plane of an attribute at this pixel.
    pub fn value(&self, attribute: impl Fn(&Vertex) -> f64) -> f64 {
        let values = self.vertices.each_ref().map(attribute);
        let (low, high) = range(values);
        if low == high {
            return low;
        }
        let weights = self.weights.map(W::as_);
        let value =
            weights.iter().zip(values).map(|(weight, value)| weight * value).sum::<f64>() / self.total.as_();
        // Rounding must not carry a value out of the range of the vertices. Outside the triangle (textbook mode draws
        // there) it lies out of the range by right.
        if weights.iter().all(|weight| *weight >= 0.0) { value.clamp(low, high) } else { value }
    }

    /// What each vertex weighs, as parts of 1.
    pub(crate) fn shares(&self) -> [f64; N] {
        self.weights.map(|weight| weight.as_() / self.total.as_())
    }

    /// The plane of an attribute at this pixel, without any rounding.
    pub fn exact(&self, attribute: impl Fn(&Vertex) -> f64) -> BigRational {
        BigRational::new(self.exact_numerator(attribute), self.total.into() << UNIT)
    }

    /// The exact order of two depths.
    pub(crate) fn compare_exact_z<const M: usize, V: Weight>(&self, other: &Fragment<M, V>) -> Ordering {
        let (low, high) = range(self.vertices.each_ref().map(|vertex| vertex.z));
        let (other_low, other_high) = range(other.vertices.each_ref().map(|vertex| vertex.z));
        if low == high && other_low == other_high {
            // Flat scenes tie at every pixel; their depths are exact as they are.
            return low.total_cmp(&other_low);
        }
        let left = self.exact_numerator(|vertex| vertex.z) * other.total.into();
        left.cmp(&(other.exact_numerator(|vertex| vertex.z) * self.total.into()))
    }

    /// Sum of weight times attribute, in units of 2^-1075, of which every f64 is a multiple.
    fn exact_numerator(&self, attribute: impl Fn(&Vertex) -> f64) -> BigInt {
        let terms = self.vertices.iter().zip(self.weights).map(|(vertex, weight)| {
            let (mantissa, exponent, sign) = attribute(vertex).integer_decode();
            (weight.into() * mantissa * sign) << (i32::from(exponent) + UNIT)
        });
        terms.sum()
    }
}

/// Least and greatest; adding 0 makes a least -0 a 0.
fn range<const N: usize>(values: [f64; N]) -> (f64, f64) {
    let low = values.into_iter().fold(f64::INFINITY, f64::min);
    let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    (low + 0.0, high)
}

/// No f64 decodes with an exponent below -1075.
const UNIT: i32 = 1075;
