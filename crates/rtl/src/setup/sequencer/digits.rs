//! The factors of a sum, and the digits that have come up.

use edgewalk_machine::sequencer::word::Act;
use edgewalk_netlist::{Reg, Signal};

use super::Parts;
use super::code::Jump;
use super::shape::factor_bits;

/// The factors of the lanes that have their own.
pub(super) struct Digits<'m> {
    pairs: Vec<[Reg<'m>; 2]>,
    /// Digits behind the signs.
    left: Reg<'m>,
    /// Leading digits may be left to skip.
    skips: Reg<'m>,
    /// A factor g is on its way.
    pub loads_g: Signal<'m>,
    loads_f: Signal<'m>,
    /// The digit that has come up is the last.
    pub is_last: Signal<'m>,
}

impl<'m> Digits<'m> {
    /// The registers, and what is loaded into them.
    pub fn new(parts: &Parts<'_, 'm>) -> Digits<'m> {
        let Parts { m, plan, .. } = parts;
        let bits = factor_bits(plan);
        m.comment("The factors of a sum: the highest bit of each is the digit that has come up.");
        let own: Vec<usize> =
            (0..parts.lanes.len()).filter(|lane| *lane == 0 || parts.has_own_edge(*lane)).collect();
        let factor = |name: &str, lane: usize| {
            m.reg(&format!("{name}{lane}"), bits).doc("factor, signed, left-aligned")
        };
        let pairs = own.iter().map(|lane| [factor("f", *lane), factor("g", *lane)]).collect();
        let left =
            m.reg("left", bits.ilog2() + 1).doc("digits that are left, the one that has come up among them");
        let skips = m.reg("skips", 1).doc("leading digits may be left to skip").reset(0);
        let loads_f = parts.later("loads_f", parts.word.get("load_f"));
        let loads_g = parts.later("loads_g", parts.word.get("load_g"));
        let is_last = left.q().eq(1).named("is_last");
        Digits { pairs, left, skips, loads_g, loads_f, is_last }
    }

    /// The word waits until leading digits are skipped.
    pub fn are_unsettled(&self) -> Signal<'m> {
        self.skips.q() | self.loads_g
    }

    /// 2 f + g of the lane's digits.
    pub fn of(&self, parts: &Parts<'_, 'm>, lane: usize) -> Signal<'m> {
        let [f, g] = self.pairs[lane];
        parts.m.cat(&[f.q().msb(), g.q().msb()])
    }

    /// Both digits are 0 in all lanes that count.
    pub fn are_zero(&self, counts: impl Fn(usize) -> Option<Signal<'m>>) -> Signal<'m> {
        !self.any(counts, |factor| factor.msb())
    }

    fn any(
        &self,
        counts: impl Fn(usize) -> Option<Signal<'m>>,
        says: impl Fn(Signal<'m>) -> Signal<'m>,
    ) -> Signal<'m> {
        let of_lane = |(lane, [f, g]): (usize, &[Reg<'m>; 2])| {
            let says = says(f.q()) | says(g.q());
            counts(lane).map_or(says, |counts| says & counts)
        };
        let all = self.pairs.iter().enumerate().map(of_lane).reduce(|any, one| any | one);
        all.unwrap_or(self.is_last) // never empty
    }

    /// The registers' updates: loaded, shifted by a word, or skipped.
    pub fn update(
        &self,
        parts: &Parts<'_, 'm>,
        zero: Signal<'m>,
        counts: impl Fn(usize) -> Option<Signal<'m>>,
    ) {
        let bits = factor_bits(parts.plan);
        let differs = |count: u32| {
            move |factor: Signal<'m>| {
                let top = factor.slice(bits - 1, bits - count);
                top.any() & !top.all()
            }
        };
        let top = self.any(&counts, differs(2)).named_doc("top", "the next digit differs from a sign");
        let top4 =
            self.any(&counts, differs(5)).named_doc("top4", "one of the next four differs from a sign");
        let more = self.left.q().gt(4);
        let ends = (top | self.is_last).named("ends");
        let by_four = (self.skips.q() & !top4 & more).named("by_four");
        let by_one = (self.skips.q() & !ends & !by_four).named("by_one");
        let word = &parts.word;
        let consumes = word.jumps(Jump::Digits) | word.jumps(Jump::More) | (word.jumps(Jump::Zeros) & zero);
        let consumes = consumes.named_doc("consumes", "the digits are done");
        let shifts = (consumes | word.does(Act::Shift)).named("shifts");
        for (lane, pair) in self.pairs.iter().enumerate() {
            let loaded = parts.of_lane(lane, "factor");
            for (register, loads) in pair.iter().zip([self.loads_f, self.loads_g]) {
                register.when(shifts | by_one, register.q().shl(1));
                register.when(by_four, register.q().shl(4));
                register.when(loads, loaded);
            }
        }
        self.left.when(consumes | by_one, self.left.q() - 1);
        self.left.when(by_four, self.left.q() - 4);
        self.left.when(self.loads_f | self.loads_g, u128::from(bits - 1));
        self.skips.when(ends, 0).when(self.loads_g, 1);
    }
}
