//! The exact fit: a plane through three values, or the quadratic through six, in integers, each word rounded once.
//!
//! With w_k what vertex k weighs at a pixel, an integer and linear in i and n, and A their sum:
//! ```text
//!   plane      sum of v_k w_k                                    over A
//!   six points sum of v_k w_k (2 w_k - A) + 4 m_k w_i w_j        over A², m_k in the middle of the edge opposite vertex k
//! ```

use super::{Degree, TermWords};
use num_bigint::{BigInt, BigUint};

/// Fraction bits of the values that a term goes through.
pub const NODE_BITS: u32 = 40;

/// A value for a term to go through, in 2^-[`NODE_BITS`], half to even; at most 2^20 in magnitude, what is beyond is cut.
#[must_use]
pub fn node(value: f64) -> i64 {
    let most = f64::from(1 << 20);
    // Times a power of two is exact; below 2^60 the cast too.
    (value.clamp(-most, most) * (1u64 << NODE_BITS) as f64).round_ties_even() as i64
}

/// What each vertex weighs at a pixel, the change to the next column of the span and to the next line, in any unit. Their
/// sum is the same at all pixels and not 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shares {
    /// Of the vertices at the pixel.
    pub here: [i64; 3],
    /// Growth of the shares a column along the span.
    pub column: [i64; 3],
    /// Growth of the shares a line down.
    pub line: [i64; 3],
}

/// The words that a term is rounded to.
struct Form {
    /// A value of 1 is 2^bits units.
    bits: u32,
    /// Units added to the value.
    offset: i64,
    /// Bits of a word.
    width: u32,
}

impl Shares {
    /// The words at the pixel of the plane through the nodes of the vertices, as [`node`] gives them: `offset` whole units
    /// and 2^`bits` units for a value of 1. `None` if no such word is, or the weights sum to 0.
    #[must_use]
    pub fn plane(&self, vertices: [i64; 3], bits: u32, offset: i64, width: u32) -> Option<TermWords> {
        let numerator = |i: i64, n: i64| {
            let weights = self.at(i, n);
            (0..3).map(|k| &weights[k] * vertices[k]).sum::<BigInt>()
        };
        self.words(numerator, Degree::Linear, &Form { bits, offset, width })
    }

    /// Like `plane`, of the quadratic through `vertices` and `midpoints`, each opposite the vertex of its place.
    #[must_use]
    pub fn six_point(
        &self,
        [vertices, midpoints]: [[i64; 3]; 2],
        bits: u32,
        offset: i64,
        width: u32,
    ) -> Option<TermWords> {
        let total = self.total();
        let numerator = |i: i64, n: i64| {
            let w = self.at(i, n);
            let part = |k: usize| {
                (&w[k] * 2 - &total) * &w[k] * vertices[k]
                    + &w[(k + 1) % 3] * &w[(k + 2) % 3] * midpoints[k] * 4
            };
            part(0) + part(1) + part(2)
        };
        self.words(numerator, Degree::Quadratic, &Form { bits, offset, width })
    }

    fn total(&self) -> BigInt {
        self.here.iter().map(|weight| BigInt::from(*weight)).sum()
    }

    fn at(&self, i: i64, n: i64) -> [BigInt; 3] {
        [0, 1, 2].map(|k| {
            BigInt::from(self.here[k]) + BigInt::from(self.column[k]) * i + BigInt::from(self.line[k]) * n
        })
    }

    /// Rounds the differences of `numerator` over the total to the power of the degree.
    fn words(
        &self,
        numerator: impl Fn(i64, i64) -> BigInt,
        degree: Degree,
        form: &Form,
    ) -> Option<TermWords> {
        let total = match degree {
            Degree::Linear => self.total(),
            Degree::Quadratic => self.total().pow(2),
        };
        if total == BigInt::ZERO {
            return None;
        }
        let [here, right, down] = [numerator(0, 0), numerator(1, 0), numerator(0, 1)];
        let second = match degree {
            Degree::Linear => [BigInt::ZERO, BigInt::ZERO, BigInt::ZERO],
            Degree::Quadratic => [
                numerator(2, 0) - &right * 2 + &here,
                numerator(1, 1) - &right - &down + &here,
                numerator(0, 2) - &down * 2 + &here,
            ],
        };
        let (x, y) = (right - &here, down - &here);
        let [xx, xy, yy] = second;
        let mut words = [here, x, y, xx, xy, yy].map(|number| rounded(number << form.bits, &total));
        words[0] = words[0].wrapping_add(form.offset as u64);
        TermWords::new(form.width, words)
    }
}

/// RN of a number over 2^[`NODE_BITS`] times `total`, modulo 2^64.
fn rounded(number: BigInt, total: &BigInt) -> u64 {
    let divisor: BigInt = total << (NODE_BITS + 1);
    let sum: BigInt = number * 2 + (total << NODE_BITS);
    // Floor, whatever the signs.
    let quotient = if divisor < BigInt::ZERO { floor(-sum, -divisor) } else { floor(sum, divisor) };
    low_word(&quotient)
}

/// Of a positive divisor.
fn floor(number: BigInt, divisor: BigInt) -> BigInt {
    let quotient = &number / &divisor;
    let exact = &quotient * &divisor == number;
    if number < BigInt::ZERO && !exact { quotient - 1 } else { quotient }
}

/// The low 64 bits, two's complement.
fn low_word(number: &BigInt) -> u64 {
    let magnitude: &BigUint = number.magnitude();
    let low = magnitude.iter_u64_digits().next().unwrap_or(0);
    if *number < BigInt::ZERO { low.wrapping_neg() } else { low }
}
