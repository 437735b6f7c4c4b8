//! The range of a word of the processor, read with its sign, as far as it is known without computing anything. It tells when a value
//! already has copies of its sign above its bits.

/// Both ends are in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Range {
    low: i64,
    high: i64,
}

impl Range {
    /// The range of one number.
    pub fn of(number: i64) -> Range {
        Range { low: number, high: number }
    }

    /// From 0 to below 2^bits, if a word with a sign has room for them.
    pub fn unsigned(bits: u32) -> Option<Range> {
        (bits < 64).then(|| Range { low: 0, high: i64::MAX >> (63 - bits) })
    }

    /// All numbers of so many bits with a sign, 1 to 64.
    pub fn signed(bits: u32) -> Range {
        Range { low: i64::MIN >> (64 - bits), high: i64::MAX >> (64 - bits) }
    }

    /// All numbers are below 2^bits, the sign being one of them.
    pub fn is_signed(self, bits: u32) -> bool {
        let all = Range::signed(bits);
        all.low <= self.low && self.high <= all.high
    }

    /// None is below 0: the bits of the largest.
    pub fn bits(self) -> Option<u32> {
        (self.low >= 0).then(|| 64 - self.high.leading_zeros())
    }

    /// What is in one of them, and between them.
    pub fn or(self, other: Range) -> Range {
        Range { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Of sums; none if one may not have room.
    pub fn plus(self, other: Range) -> Option<Range> {
        Some(Range { low: self.low.checked_add(other.low)?, high: self.high.checked_add(other.high)? })
    }

    /// Of differences.
    pub fn minus(self, other: Range) -> Option<Range> {
        Some(Range { low: self.low.checked_sub(other.high)?, high: self.high.checked_sub(other.low)? })
    }

    /// Of what is shifted left.
    pub fn times_power(self, n: u32) -> Option<Range> {
        let power = 1i64.checked_shl(n).filter(|power| *power > 0)?;
        Some(Range { low: self.low.checked_mul(power)?, high: self.high.checked_mul(power)? })
    }

    /// Of numbers whose bits above those that either has are copies of the sign: what `And`, `Or` and `Xor` make of two.
    pub fn of_bits(self, other: Range) -> Range {
        let bits = |range: Range| {
            let magnitude = |number: i64| 65 - (number ^ number >> 63).leading_zeros();
            magnitude(range.low).max(magnitude(range.high))
        };
        let all = Range::signed(bits(self).max(bits(other)));
        if self.low >= 0 && other.low >= 0 { Range { low: 0, ..all } } else { all }
    }
}
