//! A value of the graph as a value of Cranelift: a bit is an `I8` that is 0 or 1, up to 64 bits are an `I64`,
//! more are an `I128`. The bits above the width are don't care until a reader needs zeros or copies of the
//! sign there.

use cranelift_codegen::ir::{Type, Value, types};

use super::range::Range;

/// A value in its forms; all have the type [`lane`] of its width.
#[derive(Clone, Copy)]
pub(super) struct Lowered {
    /// The value's bits; above them anything.
    pub any: Value,
    /// `any` is below 2^bits.
    pub bits: u32,
    /// Where `any` lies, read with its sign, if something is known of it.
    pub range: Option<Range>,
    /// With zeros above.
    pub zero: Option<Value>,
    /// With copies of the sign above.
    pub sign: Option<Value>,
    /// Of a bit, `any` as a word, below 2^bits too: as which it was read or worked out.
    pub word: Option<Value>,
    /// The value stands in its place in the state, as `any`, and has to be read there.
    pub is_kept: bool,
}

impl Lowered {
    /// Anything above the value's bits, but `any` is below 2^bits.
    pub fn below(any: Value, bits: u32) -> Lowered {
        Lowered {
            any,
            bits,
            range: Range::unsigned(bits),
            zero: None,
            sign: None,
            word: None,
            is_kept: false,
        }
    }

    /// Anything above the value's bits, but `any` is below 2^bits, and in the range if there is one.
    pub fn within(any: Value, bits: u32, range: Option<Range>) -> Lowered {
        let bits = range.and_then(Range::bits).map_or(bits, |of_range| of_range.min(bits));
        Lowered { range: range.or(Range::unsigned(bits)), ..Lowered::below(any, bits) }
    }

    /// A bit that is there as this word, below 2^bits.
    pub fn bit(any: Value, word: Value, bits: u32) -> Lowered {
        Lowered { word: Some(word), ..Lowered::below(any, bits) }
    }

    /// Copies of the sign above so many bits.
    pub fn signed(any: Value, width: u32) -> Lowered {
        let range = (width <= 64).then(|| Range::signed(width));
        Lowered { range, sign: Some(any), ..Lowered::below(any, u32::MAX) }
    }

    /// One of two, which is there as `any`.
    pub fn either(any: Value, a: Lowered, b: Lowered) -> Lowered {
        Lowered::within(any, a.bits.max(b.bits), a.ranges(b).map(|(a, b)| a.or(b)))
    }

    /// Where both are known to lie.
    pub fn ranges(self, other: Lowered) -> Option<(Range, Range)> {
        self.range.zip(other.range)
    }
}

/// The type for values of so many bits.
pub(super) fn lane(width: u32) -> Type {
    match width {
        1 => types::I8,
        2..=64 => types::I64,
        _ => types::I128,
    }
}
