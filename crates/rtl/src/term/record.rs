//! The reading of a triangle's record, and where its words lie in it.

use edgewalk_machine::{Plan, Term};
use edgewalk_netlist::{Module, Reg, Signal};

use super::lowest;
use crate::ports::FromMemory;

/// Places of the words that no term has.
pub(super) const REF_X: u32 = 0;
pub(super) const REF_Y: u32 = 1;
pub(super) const MATERIAL: u32 = 2;
const FIRST: u32 = 3;

/// Of the words of a term, from its first on; of degree 1 only three are there.
pub(super) const V: u32 = 0;
pub(super) const X: u32 = 1;
pub(super) const Y: u32 = 2;
pub(super) const XX: u32 = 3;
pub(super) const XY: u32 = 4;
pub(super) const YY: u32 = 5;

/// The terms with the place of the first word of each.
pub(super) fn places(plan: &Plan) -> Vec<(Term, u32)> {
    let mut place = FIRST;
    let placed = plan.terms().iter().map(|term| {
        place += term.words();
        (*term, place - term.words())
    });
    placed.collect()
}

/// A record on its way from the memory.
pub(super) struct Record<'m> {
    pub loading: Signal<'m>,
    /// To be cleared when the triangle's first span goes.
    pub begun: Reg<'m>,
    pub read_valid: Signal<'m>,
    /// Of the word that is asked for, in its record.
    pub read_place: Signal<'m>,
    /// A word comes, and this is its place.
    pub comes: Signal<'m>,
    pub place: Signal<'m>,
    pub word: Signal<'m>,
}

impl<'m> Record<'m> {
    /// The record is read when a triangle's first span is offered.
    pub fn new(m: &'m Module, plan: &Plan, terms: &FromMemory<'m>, fresh_offered: Signal<'m>) -> Record<'m> {
        m.comment("Record: one read request a clock; words are loaded as they arrive.");
        let (length, bits) = (plan.record_length(), plan.record_place_bits());
        let loading = m.reg("loading", 1).doc("a record is being read").reset(0);
        let begun = m.reg("begun", 1).doc("the offered span's record is loaded").reset(0);
        let asked = m.reg("asked", length.ilog2() + 1).doc("words requested");
        let taken = m.reg("taken", bits).doc("words received");
        let begins = (fresh_offered & !begun.q() & !loading.q()).named("begins");
        let read_valid = (loading.q() & asked.q().ne(length as i32)).named("trd_valid");
        let comes = (loading.q() & terms.data_valid).named("word_comes");
        let last = (comes & taken.q().eq(length as i32 - 1)).named("last_word");
        loading.when(last, 0).when(begins, 1);
        begun.when(last, 1);
        asked.when(read_valid & terms.read_ready, asked.q() + 1).when(begins, 0);
        taken.when(comes, taken.q() + 1).when(begins, 0);
        Record {
            loading: loading.q(),
            begun,
            read_valid,
            read_place: lowest(asked.q(), bits),
            comes,
            place: taken.q(),
            word: terms.data["word"],
        }
    }

    /// The register takes the word of that place, its low bits.
    pub fn load(&self, register: Reg<'m>, place: u32) {
        self.load_above(register, place, 0);
    }

    /// The register takes its bits from bit `low` on.
    pub fn load_above(&self, register: Reg<'m>, place: u32, low: u32) {
        let takes = self.comes & self.place.eq(place as i32);
        let bits = register.q().width();
        let own = if low == 0 { lowest(self.word, bits) } else { self.word.slice(low + bits - 1, low) };
        register.when(takes, own);
    }
}
