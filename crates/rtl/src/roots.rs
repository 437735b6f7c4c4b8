//! The table of roots of NORMAL, or the tables of LAMP, and how they come.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Memory, Module, Signal};

use crate::ports::FromMemory;

/// The words.
pub(crate) struct Roots<'m> {
    /// The table is inside.
    pub have: Signal<'m>,
    pub loading: Signal<'m>,
    pub read_valid: Signal<'m>,
    pub read_place: Signal<'m>,
    /// A word comes, and it is the one with this number.
    pub comes: Signal<'m>,
    pub taken: Signal<'m>,
    table: Memory<'m>,
}

impl<'m> Roots<'m> {
    /// `frag_valid`: a fragment is offered, so the table is needed; `what` it is.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        what: &str,
        frag_valid: Signal<'m>,
        memory: &FromMemory<'m>,
    ) -> Roots<'m> {
        m.comment(&format!("Fetch of {what}: one read request a clock; words are loaded as they arrive."));
        let words = plan.root_words();
        let bits = words.ilog2();
        let have = m.reg("have", 1).doc("the table is loaded").reset(0);
        let loading = m.reg("loading", 1).doc("the table is being fetched").reset(0);
        let asked = m.reg("asked", bits + 1).doc("words requested");
        let taken = m.reg("taken", bits).doc("words received");
        let begins = (frag_valid & !have.q() & !loading.q()).named("begins");
        // As many words as numbers of so many bits: the bit above says that all are asked for.
        let read_valid = (loading.q() & !asked.q().msb()).named("rrd_valid");
        let comes = (loading.q() & memory.data_valid).named("word_comes");
        let last = (comes & taken.q().all()).named("last_word");
        have.when(last, 1);
        loading.when(last, 0).when(begins, 1);
        asked.when(read_valid & memory.read_ready, asked.q() + 1).when(begins, 0);
        taken.when(comes, taken.q() + 1).when(begins, 0);
        let table = m.memory("roots", bits, words as usize, plan.root_word_bits());
        let table = table.doc(&format!("{what}: v and slope")).write(comes, taken.q(), memory.data["word"]);
        let read_place = asked.q().trunc(bits);
        let (have, loading, taken) = (have.q(), loading.q(), taken.q());
        Roots { have, loading, read_valid, read_place, comes, taken, table }
    }

    /// The entry, as a register of the stage behind.
    pub fn read(&self, when: Signal<'m>, entry: Signal<'m>) -> Signal<'m> {
        self.table.read(when, entry)
    }
}
