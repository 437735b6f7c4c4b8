//! A lane of SETUP: the steps of pairs, each carried out and counted, with what the text promises of every step held against it.

/// The number w + rest/M; w modular.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pair {
    pub w: i128,
    pub rest: i128,
    /// The clock of its last step.
    at: u32,
}

/// What a lane divides by, and how far it is in its round.
#[derive(Clone, Copy, Debug)]
pub struct Lane {
    m: i128,
    /// Of w.
    bits: u32,
    /// Clocks so far.
    pub clock: u32,
    /// The clock in which the last result that is rounded is known.
    rounds: u32,
}

impl Lane {
    pub fn new(m: i128, bits: u32) -> Self {
        Lane { m, bits, clock: 0, rounds: 0 }
    }

    /// Another M: what was to be rounded by the old one has been.
    pub fn change_m(&mut self, m: i128) {
        self.m = m;
        self.end();
    }

    /// M may change now; the clocks of the round.
    pub fn end(&self) -> u32 {
        assert!(self.rounds <= self.clock, "M changes while {self:?} rounds");
        self.clock
    }

    /// w + rest/M of a rest below 3M.
    fn pair(&self, w: i128, rest: i128) -> Pair {
        let over = i128::from(rest >= self.m) + i128::from(rest >= 2 * self.m);
        let rest = rest - over * self.m;
        assert!((0..self.m).contains(&rest), "{rest} of {self:?}");
        Pair { w: (w + over) & ((1 << self.bits) - 1), rest, at: self.clock }
    }

    /// A pair that is a or b, or is added, in this clock.
    fn stored(&self, pair: Pair) -> Pair {
        assert!(pair.at + 3 <= self.clock, "{pair:?} does not stand yet, {self:?}");
        pair
    }

    /// A pair whose last step was in the clock before.
    fn held(&self, pair: Pair) -> Pair {
        assert_eq!(pair.at, self.clock, "{self:?} has gone on");
        pair
    }

    pub fn wait(&mut self, clocks: u32) {
        self.clock += clocks;
    }

    pub fn fits(m: i128, d: i128) -> bool {
        -m <= d && d < m
    }

    /// D/M: had at once, where this and all that other lanes take in fit, or from its sign and `bits` more, two a clock.
    pub fn take_in(&mut self, d: i128, all_fit: bool, bits: u32) -> Pair {
        self.clock += 1;
        if all_fit {
            assert!(Self::fits(self.m, d), "{d} does not fit, {self:?}");
            return if d < 0 { self.pair(-1, d + self.m) } else { self.pair(0, d) };
        }
        self.clock += 2; // one is lost, one takes in the sign
        let mut pair = if d < 0 { self.pair(-1, self.m - 1) } else { self.pair(0, 0) };
        for i in (0..bits).rev() {
            self.clock += u32::from(i % 2 == 0); // if their number is odd, the first comes alone
            pair = self.pair(2 * pair.w, 2 * pair.rest + (d >> i & 1));
        }
        pair
    }

    /// To what is held, a stored pair.
    pub fn add(&mut self, a: Pair, b: Pair) -> Pair {
        let a = self.held(a);
        self.clock += 1;
        let b = self.stored(b);
        self.pair(a.w + b.w, a.rest + b.rest)
    }

    /// In as many clocks as the lane with most doublings asks for.
    pub fn double(&mut self, a: Pair, times: u32, clocks: u32) -> Pair {
        assert!(times <= 2 * clocks, "{times} doublings in {clocks} clocks");
        let a = self.held(a);
        self.clock += clocks;
        (0..times).fold(self.pair(a.w, a.rest), |a, _| self.pair(2 * a.w, 2 * a.rest))
    }

    /// f·a + g·b of a, b and a + b, the most significant of `bits` first; of numbers with a sign that bit subtracts.
    pub fn sum(&mut self, [f, g]: [i128; 2], [a, b, both]: [Pair; 3], bits: u32, signed: bool) -> Pair {
        let expected = self.pair(a.w + b.w, a.rest + b.rest);
        assert_eq!((both.w, both.rest), (expected.w, expected.rest), "a + b, {self:?}");
        let mut sum = Pair::default();
        for i in (0..bits).rev() {
            self.clock += 1;
            let chosen = match (f >> i & 1, g >> i & 1) {
                (0, 0) => Pair::default(),
                (_, 0) => self.stored(a),
                (0, _) => self.stored(b),
                _ => self.stored(both),
            };
            let taken_off = signed && i == bits - 1; // from 0
            sum = if taken_off && chosen.rest > 0 {
                self.pair(-chosen.w - 1, self.m - chosen.rest)
            } else if taken_off {
                self.pair(-chosen.w, 0)
            } else {
                self.pair(2 * sum.w + chosen.w, 2 * sum.rest + chosen.rest)
            };
        }
        sum
    }

    /// A number that is seen behind this pair is known, rounded or not.
    pub fn knows(&self, pair: Pair) {
        assert!(pair.at + 2 <= self.clock, "{pair:?} is not rounded yet, {self:?}");
    }

    /// RN, known two clocks behind the last step.
    pub fn round(&mut self, a: Pair) -> i128 {
        self.rounds = self.rounds.max(a.at + 2);
        a.w + i128::from(2 * a.rest >= self.m)
    }
}

/// Bits of the longest of some numbers that are not negative.
pub fn u(numbers: &[i128]) -> u32 {
    let bits = |n: &i128| (0..).find(|bits| n >> bits == 0).expect("not negative");
    numbers.iter().map(bits).max().unwrap_or(0).max(1)
}

/// The same in two's complement.
pub fn s(numbers: &[i128]) -> u32 {
    let bits =
        |n: &i128| (1..).find(|bits| (-1..=0).contains(&(n >> (bits - 1)))).expect("no number is longer");
    numbers.iter().map(bits).max().unwrap_or(0).max(2)
}

/// A number that is summed up over so many bits of others, the most significant first: what bit i adds.
pub fn over_bits(bits: u32, adds: impl Fn(u32) -> i128) -> i128 {
    (0..bits).rev().fold(0, |sum, i| 2 * sum + adds(i))
}
