//! The factors of a sum, and the digits that are left of them.

/// Both factors of a lane, left-aligned: the highest bit is the digit that has come up.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pair {
    pub f: u64,
    pub g: u64,
}

/// The length of the factors, and how many of their digits are left.
#[derive(Clone, Debug)]
pub(super) struct Digits {
    /// Bits of a factor, signed.
    bits: u32,
    /// Digits behind the sign.
    left: u32,
    /// The clock from which no leading digit is left to skip.
    settled: u32,
}

impl Pair {
    /// 2 f + g of the digits that have come up.
    pub fn digits(self, bits: u32) -> u8 {
        let of = |factor: u64| (factor >> (bits - 1)) as u8 & 1;
        2 * of(self.f) + of(self.g)
    }

    /// The next digits come up.
    pub fn shift(&mut self, places: u32, bits: u32) {
        for factor in [&mut self.f, &mut self.g] {
            *factor = *factor << places & ((1 << bits) - 1);
        }
    }

    /// The highest `count` bits of each factor are equal.
    fn leads(self, count: u32, bits: u32) -> bool {
        [self.f, self.g].into_iter().all(|factor| {
            let top = factor >> (bits - count);
            top == 0 || top == (1 << count) - 1
        })
    }
}

impl Digits {
    /// Of factors of so many bits.
    pub fn new(bits: u32) -> Digits {
        Digits { bits, left: bits - 1, settled: 0 }
    }

    pub fn bits(&self) -> u32 {
        self.bits
    }

    /// The digit that has come up is the last.
    pub fn is_last(&self) -> bool {
        self.left == 1
    }

    /// A digit is done.
    pub fn next(&mut self) {
        self.left = self.left.wrapping_sub(1);
    }

    /// A factor is loaded by the word of this clock.
    pub fn load(&mut self) {
        self.left = self.bits - 1;
    }

    /// Skips the digits that are equal to the signs of all factors of the lanes that count, four or one a clock, from two
    /// clocks behind that of the word which loads g.
    pub fn skip(&mut self, clock: u32, lanes: &mut [Pair], counts: impl Fn(usize) -> bool) {
        let mut skips = 0;
        let bits = self.bits;
        while self.left > 1 {
            let lead =
                |count| lanes.iter().enumerate().all(|(lane, pair)| !counts(lane) || pair.leads(count, bits));
            let places = match (lead(5), lead(2)) {
                (true, _) if self.left > 4 => 4,
                (_, true) => 1,
                _ => break,
            };
            lanes.iter_mut().for_each(|pair| pair.shift(places, bits));
            self.left -= places;
            skips += 1;
        }
        self.settled = clock + 3 + skips;
    }

    /// Nothing is left to skip.
    pub fn are_settled(&self, clock: u32) -> bool {
        clock >= self.settled
    }
}
