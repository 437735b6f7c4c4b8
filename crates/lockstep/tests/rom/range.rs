//! Bounds of whole numbers.

/// Bounds of a whole number, and whether it is a multiple of P for certain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    pub low: i128,
    pub high: i128,
    pub lines: bool,
}

/// Farther than any A lies.
pub const FAR: i128 = 1 << 100;

impl Range {
    pub const ANY: Range = Range { low: -FAR, high: FAR, lines: false };
    pub const ZERO: Range = Range { low: 0, high: 0, lines: true };

    pub fn is_zero(self) -> bool {
        (self.low, self.high) == (0, 0)
    }

    /// Whether it can be below 0, and 0 or above.
    pub fn signs(self) -> Vec<bool> {
        [true, false]
            .into_iter()
            .filter(|negative| if *negative { self.low < 0 } else { self.high >= 0 })
            .collect()
    }

    /// The part below 0, or the other.
    pub fn of_sign(self, negative: bool) -> Range {
        match negative {
            true => Range { high: self.high.min(-1), ..self },
            false => Range { low: self.low.max(0), ..self },
        }
    }

    /// The multiples of P in it, if it is one.
    pub fn rounded(self, pixel: i128) -> Range {
        let floor = |number: i128| number.div_euclid(pixel) * pixel;
        if self.lines {
            Range { low: floor(self.low + pixel - 1), high: floor(self.high), ..self }
        } else {
            self
        }
    }

    /// So many times.
    pub fn times(self, count: i128) -> Range {
        let of = |number: i128| number.saturating_mul(count).clamp(-FAR, FAR);
        let [low, high] =
            if count < 0 { [of(self.high), of(self.low)] } else { [of(self.low), of(self.high)] };
        Range { low, high, ..self }
    }

    pub fn join(self, other: Range) -> Range {
        Range {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            lines: self.lines && other.lines,
        }
    }

    pub fn plus(self, other: Range, minus: bool) -> Range {
        let (low, high) = if minus { (-other.high, -other.low) } else { (other.low, other.high) };
        let cut = |number: i128| number.clamp(-FAR, FAR);
        Range { low: cut(self.low + low), high: cut(self.high + high), lines: self.lines && other.lines }
    }
}
