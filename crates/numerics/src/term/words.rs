//! The six words of a term, modulo 2^w.

/// Longest word of a term.
pub const MAX_TERM_BITS: u32 = 64;

/// V X Y XX XY YY at a pixel, words of w bits, two's complement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TermWords {
    width: u32,
    /// V, X, Y, XX, XY, YY.
    words: [u64; 6],
}

impl TermWords {
    /// The low `width` bits of the words; `None` of no or more than [`MAX_TERM_BITS`] bits.
    #[must_use]
    pub fn new(width: u32, words: [u64; 6]) -> Option<Self> {
        let fits = (1..=MAX_TERM_BITS).contains(&width);
        fits.then(|| Self { width, words: words.map(|word| word & mask(width)) })
    }

    /// w.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// V, X, Y, XX, XY, YY, each below 2^w.
    #[must_use]
    pub fn words(&self) -> [u64; 6] {
        self.words
    }

    /// The word i columns along the span and n lines down: formula (1), modulo 2^w.
    #[must_use]
    pub fn at(&self, i: i64, n: i64) -> u64 {
        self.moved(i, n).words[0]
    }

    /// The six words there: each value of (1) is the same from both, as (1) holds in any ring.
    #[must_use]
    pub fn moved(&self, i: i64, n: i64) -> Self {
        let [v, x, y, xx, xy, yy] = self.words;
        let times = |word: u64, count: i128| word.wrapping_mul(count as u64);
        let pairs = |count: i64| i128::from(count) * (i128::from(count) - 1) / 2;
        let sum =
            |parts: &[u64]| parts.iter().fold(0, |sum: u64, part| sum.wrapping_add(*part)) & mask(self.width);
        let (columns, lines) = (i128::from(i), i128::from(n));
        let words = [
            sum(&[
                v,
                times(x, columns),
                times(y, lines),
                times(xx, pairs(i)),
                times(yy, pairs(n)),
                times(xy, columns.wrapping_mul(lines)),
            ]),
            sum(&[x, times(xx, columns), times(xy, lines)]),
            sum(&[y, times(yy, lines), times(xy, columns)]),
            xx,
            xy,
            yy,
        ];
        Self { words, ..*self }
    }
}

fn mask(width: u32) -> u64 {
    u64::MAX >> (MAX_TERM_BITS - width)
}
