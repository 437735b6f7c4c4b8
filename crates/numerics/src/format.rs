//! Fixed-point formats chosen at run time.

use crate::dyadic::Dyadic;
use crate::interval::Interval;
use std::fmt;
use std::str::FromStr;

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

/// Why there is no such format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// Too many bits, or none.
    #[error("{integer_bits} integer and {fraction_bits} fraction bits: a word has 1 to {max} bits", max = Format::MAX_WIDTH)]
    Width {
        /// Integer bits asked for, the sign included.
        integer_bits: u32,
        /// Fraction bits asked for.
        fraction_bits: u32,
    },
    /// Not of the form `Q12.16`.
    #[error(
        "{0:?} is no format: write Q<integer bits>.<fraction bits>, or UQ for unsigned, as in Q12.16 or UQ8.14"
    )]
    Syntax(String),
}

impl Format {
    /// Widest word in bits: sums and rounding remainders still fit an `i128`.
    pub const MAX_WIDTH: u32 = 120;

    /// Checks the width, 1 to 120 bits in all.
    pub fn new(signed: bool, integer_bits: u32, fraction_bits: u32) -> Result<Format, FormatError> {
        match integer_bits.checked_add(fraction_bits) {
            Some(1..=Format::MAX_WIDTH) => Ok(Format { signed, integer_bits, fraction_bits }),
            _ => Err(FormatError::Width { integer_bits, fraction_bits }),
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

    /// The values a word can have.
    pub fn range(self) -> Interval {
        let [low, high] = [self.min_raw(), self.max_raw()].map(|raw| self.value_of(raw));
        Interval::point(low).hull(Interval::point(high))
    }

    /// The number that a raw value stands for.
    pub(crate) fn value_of(self, raw: i128) -> Dyadic {
        Dyadic::new(raw, self.fraction_bits).expect("at most 120 bits in all")
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = if self.signed { "Q" } else { "UQ" };
        f.pad(&format!("{prefix}{}.{}", self.integer_bits, self.fraction_bits))
    }
}

impl FromStr for Format {
    type Err = FormatError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let syntax = || FormatError::Syntax(text.to_owned());
        let number = |digits: &str| {
            let plain = digits.bytes().all(|byte| byte.is_ascii_digit()); // u32 alone would take "+3"
            digits.parse::<u32>().ok().filter(|_| plain).ok_or_else(syntax)
        };
        let (signed, rest) = match text.strip_prefix("UQ") {
            Some(rest) => (false, rest),
            None => (true, text.strip_prefix('Q').ok_or_else(syntax)?),
        };
        let (integer, fraction) = rest.split_once('.').ok_or_else(syntax)?;
        Format::new(signed, number(integer)?, number(fraction)?)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;

    #[test]
    fn every_format_parses_back() {
        let mut checked = 0;
        for integer in 0..=Format::MAX_WIDTH {
            for fraction in 0..=Format::MAX_WIDTH {
                for signed in [false, true] {
                    let Ok(format) = Format::new(signed, integer, fraction) else {
                        assert!(integer + fraction == 0 || integer + fraction > 120);
                        continue;
                    };
                    assert_eq!(format.to_string().parse(), Ok(format));
                    checked += 1;
                }
            }
        }
        assert_eq!(checked, 2 * (121 * 122 / 2 - 1));
    }

    #[test]
    fn malformed_texts_are_refused_with_the_form() {
        for text in
            ["", "Q", "UQ", "q1.2", "Q12", "Q.", "Q1.", "Q.1", "Q-1.2", "Q+1.2", "SQ1.2", "Q1.2.3", "Q1. 2"]
        {
            let error = text.parse::<Format>().unwrap_err();
            assert_eq!(error, FormatError::Syntax(text.to_owned()));
            assert!(error.to_string().contains("Q12.16"));
        }
        for text in ["Q0.0", "Q121.0", "UQ60.61", "Q4294967295.4294967295"] {
            assert!(matches!(text.parse::<Format>(), Err(FormatError::Width { .. })), "{text}");
        }
        assert!("Q4294967296.0".parse::<Format>().is_err());
    }

    #[test]
    fn ranges_count_the_sign_among_the_integer_bits() {
        let q: Format = "Q3.2".parse().unwrap();
        assert_eq!((q.width(), q.min_raw(), q.max_raw()), (5, -16, 15));
        assert_eq!(q.range().to_string(), "[-4, 3.75]");
        let uq: Format = "UQ3.2".parse().unwrap();
        assert_eq!((uq.min_raw(), uq.max_raw()), (0, 31));
        assert_eq!(uq.range().to_string(), "[0, 7.75]");
        let widest = Format::unsigned(120, 0).unwrap();
        assert_eq!(widest.max_raw(), (1 << 120) - 1);
    }
}
