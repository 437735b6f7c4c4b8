//! Fixed-point formats chosen at run time.

use std::fmt;

/// Sign, integer bits and fraction bits of a word: `Q12.16` signed (two's complement), `UQ8.14` unsigned.
///
/// The sign bit counts among the integer bits, so the width is always their sum (as in `I12F16` of crate
/// `fixed`): `Q12.16` has 28 bits and ranges over [-2^11, 2^11 - 2^-16].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Format {
    signed: bool,
    integer_bits: u32,
    fraction_bits: u32,
}

/// There is no such format: it has too many bits, or none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{integer_bits} integer and {fraction_bits} fraction bits: a word has 1 to {max} bits", max = Format::MAX_WIDTH)]
pub struct FormatError {
    /// Integer bits asked for, the sign included.
    integer_bits: u32,
    /// Fraction bits asked for.
    fraction_bits: u32,
}

impl Format {
    /// Widest word in bits: sums and rounding remainders still fit an `i128`.
    pub const MAX_WIDTH: u32 = 120;

    /// Checks the width, 1 to 120 bits in all.
    pub fn new(signed: bool, integer_bits: u32, fraction_bits: u32) -> Result<Format, FormatError> {
        match integer_bits.checked_add(fraction_bits) {
            Some(1..=Format::MAX_WIDTH) => Ok(Format { signed, integer_bits, fraction_bits }),
            _ => Err(FormatError { integer_bits, fraction_bits }),
        }
    }

    /// Signed, the sign bit one of the integer bits: `Q<integer_bits>.<fraction_bits>`.
    pub fn signed(integer_bits: u32, fraction_bits: u32) -> Result<Format, FormatError> {
        Format::new(true, integer_bits, fraction_bits)
    }

    /// Unsigned: `UQ<integer_bits>.<fraction_bits>`.
    pub fn unsigned(integer_bits: u32, fraction_bits: u32) -> Result<Format, FormatError> {
        Format::new(false, integer_bits, fraction_bits)
    }

    /// Whether words are two's complement.
    pub const fn is_signed(self) -> bool {
        self.signed
    }

    /// Bits of weight 1 and more, the sign bit included.
    pub const fn integer_bits(self) -> u32 {
        self.integer_bits
    }

    /// Bits of weight less than 1.
    pub const fn fraction_bits(self) -> u32 {
        self.fraction_bits
    }

    /// Bits in all, 1 to 120.
    pub const fn width(self) -> u32 {
        self.integer_bits + self.fraction_bits
    }

    /// Smallest raw value: 0, or -2^(width-1).
    pub const fn min_raw(self) -> i128 {
        if self.signed { -(1 << (self.width() - 1)) } else { 0 }
    }

    /// Largest raw value: 2^width - 1, or 2^(width-1) - 1.
    pub const fn max_raw(self) -> i128 {
        (1 << (self.width() - self.signed as u32)) - 1
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = if self.signed { "Q" } else { "UQ" };
        f.pad(&format!("{prefix}{}.{}", self.integer_bits, self.fraction_bits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_have_1_to_120_bits() {
        let mut checked = 0;
        for integer in 0..=Format::MAX_WIDTH + 1 {
            for fraction in 0..=Format::MAX_WIDTH + 1 {
                let width = integer + fraction;
                let format = Format::signed(integer, fraction);
                assert_eq!(format.is_ok(), (1..=120).contains(&width), "{integer} {fraction}");
                checked += 1;
            }
        }
        assert_eq!(checked, 122 * 122);
        let error = Format::unsigned(u32::MAX, u32::MAX).expect_err("too wide").to_string();
        assert!(error.contains("a word has 1 to 120 bits"), "{error}");
    }

    #[test]
    fn the_sign_counts_among_the_integer_bits() {
        let signed = Format::signed(3, 2).expect("5 bits");
        assert_eq!((signed.width(), signed.min_raw(), signed.max_raw()), (5, -16, 15));
        let unsigned = Format::unsigned(3, 2).expect("5 bits");
        assert_eq!((unsigned.min_raw(), unsigned.max_raw()), (0, 31));
        assert_eq!([signed, unsigned].map(|format| format.to_string()), ["Q3.2", "UQ3.2"]);
        assert_eq!(Format::unsigned(120, 0).map(Format::max_raw), Ok((1 << 120) - 1));
    }
}
