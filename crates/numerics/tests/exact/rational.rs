//! Exact rationals, as the independent arithmetic that the numbers of the crate are checked against.

use edgewalk_numerics::{Dyadic, Rounding};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// `n / d`.
pub fn ratio(n: impl Into<BigInt>, d: impl Into<BigInt>) -> BigRational {
    BigRational::new(n.into(), d.into())
}

/// 2^bits.
pub fn power_of_two(bits: u32) -> BigRational {
    BigRational::from_integer(BigInt::one() << bits)
}

/// The number a dyadic stands for.
pub fn exact(value: Dyadic) -> BigRational {
    BigRational::from_integer(value.numerator().into()) / power_of_two(value.fraction_bits())
}

/// Rounds to an integer, straight from the definitions and by no division of the crate.
pub fn round_to_integer(value: &BigRational, rounding: Rounding) -> BigInt {
    let (floor, ceiling) = (value.floor().to_integer(), value.ceil().to_integer());
    let half = ratio(1, 2);
    let above = value - value.floor();
    let nearest = |at_half: &BigInt| {
        if above == half {
            at_half.clone()
        } else if above < half {
            floor.clone()
        } else {
            ceiling.clone()
        }
    };
    let away = if value.is_negative() { &floor } else { &ceiling };
    match rounding {
        Rounding::Floor => floor.clone(),
        Rounding::Ceiling => ceiling.clone(),
        Rounding::TowardZero => value.trunc().to_integer(),
        Rounding::AwayFromZero => away.clone(),
        Rounding::NearestHalfUp => nearest(&ceiling),
        Rounding::NearestHalfEven => {
            nearest(if (&floor % BigInt::from(2)).is_zero() { &floor } else { &ceiling })
        }
        Rounding::NearestHalfAway => nearest(away),
    }
}

/// Rounds to a multiple of 2^-`fraction_bits`.
pub fn rounded(value: &BigRational, fraction_bits: u32, rounding: Rounding) -> BigRational {
    let scale = power_of_two(fraction_bits);
    BigRational::from_integer(round_to_integer(&(value * &scale), rounding)) / scale
}
