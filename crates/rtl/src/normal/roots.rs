//! The table of roots, and how it comes.

use edgewalk_netlist::{Memory, Module, Signal};

use crate::ports::FromMemory;

/// Table R.
pub(super) struct Roots<'m> {
    /// It is inside.
    pub have: Signal<'m>,
    pub loading: Signal<'m>,
    pub read_valid: Signal<'m>,
    pub read_place: Signal<'m>,
    table: Memory<'m>,
}

impl<'m> Roots<'m> {
    /// `frag_valid`: a fragment is offered, so the table is needed.
    pub fn new(m: &'m Module, frag_valid: Signal<'m>, memory: &FromMemory<'m>) -> Roots<'m> {
        m.comment("The fetching of table R: asked for a word a clock, taken as the words come.");
        let have = m.reg("have", 1).doc("the table is inside").reset(0);
        let loading = m.reg("loading", 1).doc("the table is being fetched").reset(0);
        let asked = m.reg("asked", 9).doc("words asked for");
        let taken = m.reg("taken", 8).doc("words that came");
        let begins = (frag_valid & !have.q() & !loading.q()).named("begins");
        // 256 words: the bit above says that all are asked for.
        let read_valid = (loading.q() & !asked.q().msb()).named("rrd_valid");
        let comes = (loading.q() & memory.data_valid).named("word_comes");
        let last = (comes & taken.q().all()).named("last_word");
        have.when(last, 1);
        loading.when(last, 0).when(begins, 1);
        asked.when(read_valid & memory.read_ready, asked.q() + 1).when(begins, 0);
        taken.when(comes, taken.q() + 1).when(begins, 0);
        let table = m.memory("roots", 8, 256, 27, 0);
        let table = table.doc("table R: v and slope").write(comes, taken.q(), memory.data["word"]);
        Roots { have: have.q(), loading: loading.q(), read_valid, read_place: asked.q().trunc(8), table }
    }

    /// The entry, as a register of the stage behind.
    pub fn read(&self, advance: Signal<'m>, entry: Signal<'m>) -> Signal<'m> {
        self.table.read(advance, entry)
    }
}
