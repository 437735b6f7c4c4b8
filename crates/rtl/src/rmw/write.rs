//! w, the register in front of the memory: a pixel stands there till all that wait for it have taken it.

use std::ops::Index;

use edgewalk_netlist::{Module, Reg, Signal};

use crate::wires::{Part, Registers};

/// A link by which w leaves: its name, and what is said of its valid.
pub(crate) type Way<'a> = (&'a str, &'a str);

/// What goes on at a way.
#[derive(Clone, Copy)]
pub(crate) struct Leaves<'m> {
    /// Ready of the link.
    pub ready: Signal<'m>,
    /// The fragment that comes is to leave by it.
    pub wanted: Signal<'m>,
}

/// The register, and by which ways it has still to leave.
pub(super) struct Write<'m> {
    fields: Registers<'m>,
    ways: Vec<Reg<'m>>,
    /// The field that permits the word to be written, if not every write of it is meant.
    enable: Option<&'static str>,
}

impl<'m> Write<'m> {
    /// Without updates yet.
    pub fn new(
        m: &'m Module,
        ways: &[Way<'_>],
        (name, fields): (&str, Vec<Part>),
        enable: Option<&'static str>,
    ) -> Write<'m> {
        let way = |(link, doc): &Way<'_>| m.reg(&format!("{link}_valid"), 1).doc(doc).reset(0);
        let ways = ways.iter().map(way).collect();
        Write { fields: Registers::new(m, name, fields), ways, enable }
    }

    /// Empty, or all of it leaves in this cycle; a ready a way.
    pub fn free(&self, ready: &[Signal<'m>]) -> Signal<'m> {
        let free = self.ways.iter().zip(ready).map(|(valid, ready)| !valid.q() | *ready);
        free.reduce(|all, one| all & one).expect("w leads to a memory at least")
    }

    /// Leaves by each way by itself; a fragment takes its place, `when` it comes to a `free` w.
    pub fn load(
        &self,
        free: Signal<'m>,
        when: Signal<'m>,
        ways: &[Leaves<'m>],
        value: impl Fn(&str) -> Signal<'m>,
    ) {
        for (valid, way) in self.ways.iter().zip(ways) {
            valid.when(way.ready, 0).when(when, way.wanted);
        }
        // A write that leaves by no way is don't care, and a free w takes any: so the decision leads to these flags only.
        self.fields.load(free, value);
    }

    /// The write has still to leave by this way.
    pub fn valid(&self, way: usize) -> Reg<'m> {
        self.ways[way]
    }

    /// By each.
    pub fn ways(&self) -> impl Iterator<Item = Reg<'m>> {
        self.ways.iter().copied()
    }

    /// The memory's word is being changed.
    pub fn changes(&self) -> Signal<'m> {
        let valid = self.ways[0].q();
        self.enable.map_or(valid, |enable| valid & self.fields[enable])
    }

    /// The word of `addr` is.
    pub fn of(&self, addr: Signal<'m>) -> Signal<'m> {
        self.changes() & self.fields["addr"].q().eq(addr)
    }
}

/// A field.
impl<'m> Index<&str> for Write<'m> {
    type Output = Reg<'m>;
    fn index(&self, name: &str) -> &Reg<'m> {
        &self.fields[name]
    }
}
