//! The tables of the material that is inside, and how those of another one come.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Memory, Module, Signal};

use super::index::Index;
use crate::ports::FromMemory;

/// Two tables a light.
pub(super) struct Tables<'m> {
    /// The fragment that is offered is of the material inside.
    pub fits: Signal<'m>,
    pub loading: Signal<'m>,
    pub read_valid: Signal<'m>,
    pub read_place: Signal<'m>,
    lights: Vec<[Memory<'m>; 2]>,
}

/// What is read for a fragment, for each light.
pub(super) struct Light<'m> {
    pub lit: Signal<'m>,
    /// Of T: three colours, or the light.
    pub diffuse: Signal<'m>,
    /// Of S.
    pub highlight: Signal<'m>,
}

impl<'m> Tables<'m> {
    /// `material` of the fragment that is offered, if there is more than one; `occupied`: fragments of the old one are inside.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        memory: &FromMemory<'m>,
        frag_valid: Signal<'m>,
        material: Option<Signal<'m>>,
        occupied: Signal<'m>,
    ) -> Tables<'m> {
        m.comment("Tables of one material, and the fetch of the next: one read request a clock; words are loaded as they arrive.");
        let shade = &plan.shade;
        let (entry_bits, table_bits) = (shade.entry_bits(), shade.table_bits);
        let have = m.reg("have", 1).doc("tables are loaded").reset(0);
        let loading = m.reg("loading", 1).doc("tables are being fetched").reset(0);
        let asked = m.reg("asked", entry_bits + 1).doc("words requested");
        let taken = m.reg("taken", entry_bits).doc("words received: light, entry");
        let current = material.map(|material| {
            (m.reg("current", material.width()).doc("material of the loaded tables"), material)
        });
        let same = current.map(|(current, material)| material.eq(current));
        let fits = same
            .map_or(have.q(), |same| have.q() & same)
            .named_doc("fits", "the tables of frag's material are loaded");
        let begins = (frag_valid & !fits & !loading.q() & !occupied).named("begins");
        // As many words as numbers of entry_bits bits: the bit above says that all are asked for.
        let read_valid = (loading.q() & !asked.q().msb()).named("srd_valid");
        let comes = (loading.q() & memory.data_valid).named("word_comes");
        let last = (comes & taken.q().all()).named("last_word");
        have.when(begins, 0).when(last, 1);
        loading.when(last, 0).when(begins, 1);
        asked.when(read_valid & memory.read_ready, asked.q() + 1).when(begins, 0);
        taken.when(comes, taken.q() + 1).when(begins, 0);
        let place = asked.q().trunc(entry_bits);
        let read_place = match current {
            None => place,
            Some((current, material)) => {
                current.when(begins, material);
                m.cat(&[current.q(), place])
            }
        };

        let (word, b) = (memory.data["word"], plan.color.bits);
        let entry = taken.q().trunc(table_bits);
        let tables = (0..shade.lights).map(|light| {
            let is_light = (shade.lights > 1).then(|| taken.q().msb().eq(light as i32));
            let write = is_light.map_or(comes, |is| comes & is).named(&format!("write{light}"));
            let parts = [("diffuse", "T", word.width() - 1, b), ("highlight", "S", b - 1, 0)];
            parts.map(|(name, table, high, low)| {
                let memory = m.memory(&format!("{name}{light}"), table_bits, 1 << table_bits, high - low + 1);
                memory.doc(&format!("table {table} of light {light}")).write(
                    write,
                    entry,
                    word.slice(high, low),
                )
            })
        });
        Tables { fits, loading: loading.q(), read_valid, read_place, lights: tables.collect() }
    }

    /// What stage B has: the entries, read as a fragment leaves stage A.
    pub fn look_up(&self, m: &'m Module, advance: Signal<'m>, indices: &[Index<'m>]) -> Vec<Light<'m>> {
        m.comment("Stage B: the entries' values.");
        let lights = self.lights.iter().zip(indices).enumerate();
        let light = |(i, ([diffuse, highlight], index)): (usize, (&[Memory<'m>; 2], &Index<'m>))| Light {
            lit: m.reg(&format!("b_lit{i}"), 1).doc("lit, from stage A").when(advance, index.lit).q(),
            diffuse: diffuse.read(advance, index.diffuse),
            highlight: highlight.read(advance, index.highlight),
        };
        lights.map(light).collect()
    }
}
