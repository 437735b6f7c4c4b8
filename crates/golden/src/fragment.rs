//! A pixel of a triangle: how much each vertex weighs there, and so depth and colour.
//!
//! The weights are exact integers, so slivers lose nothing. A value is (w0 a0 + w1 a1 + w2 a2) / (w0 + w1 + w2): where
//! no weight is negative nothing cancels, and with u = 2^-53 a weight, a product, two sums, the total and the quotient
//! round once each: relative error below 6.01 u. [`Fragment::UNCERTAINTY`] is that bound with something to spare.

use edgewalk_scene::Vertex;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Float;
use std::cmp::Ordering;

/// A pixel of a triangle.
#[derive(Debug, Clone)]
pub struct Fragment<'a> {
    /// Column, pixels from the left of the screen.
    pub x: u32,
    /// Row, pixels from the top of the screen.
    pub y: u32,
    /// The triangle; in flat mode all three have the first one's colour.
    pub(crate) vertices: &'a [Vertex; 3],
    /// What each vertex weighs.
    pub(crate) weights: [i64; 3],
    /// Sum of the weights, positive.
    pub(crate) total: i64,
}

impl Fragment<'_> {
    /// Relative error of every value inside the triangle is below this.
    pub const UNCERTAINTY: f64 = 7.0 / (1u64 << 53) as f64;

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

    /// The plane of an attribute at this pixel.
    pub fn value(&self, attribute: impl Fn(&Vertex) -> f64) -> f64 {
        let values = self.vertices.each_ref().map(attribute);
        let (low, high) = range(values);
        if low == high {
            return low;
        }
        let [w0, w1, w2] = self.weights.map(|weight| weight as f64);
        let value = (w0 * values[0] + w1 * values[1] + w2 * values[2]) / self.total as f64;
        // Rounding must not carry a value out of the range of the vertices. Outside the triangle (textbook mode draws
        // there) it lies out of the range by right.
        if w0 >= 0.0 && w1 >= 0.0 && w2 >= 0.0 { value.clamp(low, high) } else { value }
    }

    /// The plane of an attribute at this pixel, without any rounding.
    pub fn exact(&self, attribute: impl Fn(&Vertex) -> f64) -> BigRational {
        BigRational::new(self.exact_numerator(attribute), BigInt::from(self.total) << UNIT)
    }

    /// The exact order of two depths.
    pub(crate) fn compare_exact_z(&self, other: &Self) -> Ordering {
        let ranges = [self, other].map(|fragment| range(fragment.vertices.each_ref().map(|vertex| vertex.z)));
        if let [(low, high), (other_low, other_high)] = ranges
            && low == high
            && other_low == other_high
        {
            // Flat scenes tie at every pixel; their depths are exact as they are.
            return low.total_cmp(&other_low);
        }
        let left = self.exact_numerator(|vertex| vertex.z) * other.total;
        left.cmp(&(other.exact_numerator(|vertex| vertex.z) * self.total))
    }

    /// Sum of weight times attribute, in units of 2^-1075, of which every f64 is a multiple.
    fn exact_numerator(&self, attribute: impl Fn(&Vertex) -> f64) -> BigInt {
        let terms = self.vertices.iter().zip(self.weights).map(|(vertex, weight)| {
            let (mantissa, exponent, sign) = attribute(vertex).integer_decode();
            (BigInt::from(weight) * mantissa * sign) << (i32::from(exponent) + UNIT)
        });
        terms.sum()
    }
}

/// Least and greatest; adding 0 makes a -0 a 0.
fn range([a, b, c]: [f64; 3]) -> (f64, f64) {
    (a.min(b).min(c) + 0.0, a.max(b).max(c) + 0.0)
}

/// No f64 decodes with an exponent below -1075.
const UNIT: i32 = 1075;
