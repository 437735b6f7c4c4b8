//! A fixed-point word that knows its format.

use crate::dyadic::Dyadic;
use crate::format::{Format, FormatError};
use crate::rounding::Rounding;
use std::fmt;

/// A raw integer and the format that gives it a value: raw · 2^-fraction_bits.
///
/// Two words are added only in one and the same format. `wrapping_*` works modulo 2^width, as an adder
/// without overflow logic does; `checked_*` refuses a result outside the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Word {
    format: Format,
    raw: i128,
}

/// Why an operation on words has no result.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WordError {
    /// Operands of different formats.
    #[error("{left} and {right} are different formats: round one to the other first")]
    Mismatch {
        /// Format of the left operand.
        left: Format,
        /// Format of the right operand.
        right: Format,
    },
    /// The exact result lies outside the format.
    #[error("the result lies outside {format}, which holds {}", format.range())]
    Overflow {
        /// Format that was to hold it.
        format: Format,
    },
    /// A product wider than any word.
    #[error(transparent)]
    Format(#[from] FormatError),
}

impl Word {
    /// The word with this raw value, if the format holds it.
    pub fn new(format: Format, raw: i128) -> Result<Word, WordError> {
        if (format.min_raw()..=format.max_raw()).contains(&raw) {
            Ok(Word { format, raw })
        } else {
            Err(WordError::Overflow { format })
        }
    }

    /// The word whose raw value equals `raw` modulo 2^width: the low bits, sign-extended if signed.
    pub const fn wrapping(format: Format, raw: i128) -> Word {
        let unused = i128::BITS - format.width(); // 8 to 127
        let raw = if format.is_signed() {
            (raw << unused) >> unused
        } else {
            (((raw as u128) << unused) >> unused) as i128
        };
        Word { format, raw }
    }

    /// `value` rounded to the format's fraction bits, if the format then holds it.
    pub fn from_value(value: Dyadic, format: Format, rounding: Rounding) -> Result<Word, WordError> {
        let rounded = value.round(format.fraction_bits(), rounding).scaled(format.fraction_bits());
        Word::new(format, rounded.ok_or(WordError::Overflow { format })?)
    }

    /// The format.
    pub const fn format(self) -> Format {
        self.format
    }

    /// The raw value, in units of the last bit.
    pub const fn raw(self) -> i128 {
        self.raw
    }

    /// The bit pattern, in the low `width` bits.
    pub const fn bits(self) -> u128 {
        let unused = i128::BITS - self.format.width();
        ((self.raw as u128) << unused) >> unused
    }

    /// The exact value.
    pub fn value(self) -> Dyadic {
        self.format.value_of(self.raw)
    }

    /// Sum modulo 2^width.
    pub fn wrapping_add(self, other: Word) -> Result<Word, WordError> {
        self.same_format(other).map(|format| Word::wrapping(format, self.raw + other.raw))
    }

    /// Difference modulo 2^width.
    pub fn wrapping_sub(self, other: Word) -> Result<Word, WordError> {
        self.same_format(other).map(|format| Word::wrapping(format, self.raw - other.raw))
    }

    /// Negative modulo 2^width.
    pub fn wrapping_neg(self) -> Word {
        Word::wrapping(self.format, -self.raw)
    }

    /// Sum, if the format holds it.
    pub fn checked_add(self, other: Word) -> Result<Word, WordError> {
        self.same_format(other).and_then(|format| Word::new(format, self.raw + other.raw))
    }

    /// Difference, if the format holds it.
    pub fn checked_sub(self, other: Word) -> Result<Word, WordError> {
        self.same_format(other).and_then(|format| Word::new(format, self.raw - other.raw))
    }

    /// Negative, if the format holds it.
    pub fn checked_neg(self) -> Result<Word, WordError> {
        Word::new(self.format, -self.raw)
    }

    /// The exact product. Integer bits add and fraction bits add (`Q3.4 · Q2.6` gives `Q5.10`); both operands
    /// are signed or both unsigned. Refused if the product is wider than 120 bits.
    pub fn full_mul(self, other: Word) -> Result<Word, WordError> {
        let (left, right) = (self.format, other.format);
        if left.is_signed() != right.is_signed() {
            return Err(WordError::Mismatch { left, right });
        }
        let format = Format::new(
            left.is_signed(),
            left.integer_bits() + right.integer_bits(),
            left.fraction_bits() + right.fraction_bits(),
        )?;
        Word::new(format, self.raw * other.raw)
    }

    /// The value in another format: rounded where fraction bits are lost, refused where it does not fit.
    pub fn checked_round_to(self, format: Format, rounding: Rounding) -> Result<Word, WordError> {
        Word::from_value(self.value(), format, rounding)
    }

    /// The value in another format: rounded where fraction bits are lost, high bits dropped modulo 2^width.
    pub fn wrapping_round_to(self, format: Format, rounding: Rounding) -> Word {
        let rounded = self.value().round(format.fraction_bits(), rounding);
        // A shift of 120 at the most; bits it loses at the top lie above any width.
        Word::wrapping(format, rounded.numerator() << (format.fraction_bits() - rounded.fraction_bits()))
    }

    fn same_format(self, other: Word) -> Result<Format, WordError> {
        if self.format == other.format {
            Ok(self.format)
        } else {
            Err(WordError::Mismatch { left: self.format, right: other.format })
        }
    }
}

impl fmt::Display for Word {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({} {:#x})", self.value(), self.format, self.bits())
    }
}
