//! A design without hierarchy: one graph of values, registers and memories.

use std::collections::BTreeMap;

use edgewalk_netlist::netlist::Contents;

use crate::graph::{Graph, ValueId};

/// A design without hierarchy.
#[derive(Clone, Debug)]
pub(crate) struct Design {
    pub graph: Graph,
    /// Of the top module, with `rst` if it has one.
    pub inputs: BTreeMap<String, ValueId>,
    /// `rst`, whether anything is reset or not.
    pub reset: ValueId,
    /// Of the top module, in order.
    pub outputs: Vec<(String, ValueId)>,
    pub registers: Vec<Register>,
    pub memories: Vec<Memory>,
    /// Runners that have a unit of their own.
    pub runners: Vec<Runner>,
    /// Every named signal by its path.
    pub signals: BTreeMap<String, ValueId>,
}

/// A register: `reset`, else the last update whose condition holds, else as it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Register {
    /// The unit that has it: 0 is the top module, each of its instances is one, with all within; those beyond hold what was
    /// taken apart.
    pub unit: usize,
    pub q: ValueId,
    pub reset: Option<u128>,
    /// Condition and value.
    pub updates: Vec<(Option<ValueId>, ValueId)>,
}

/// A register that changes in every clock, but of which its unit sees nothing most of the time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Runner {
    pub q: ValueId,
    /// The unit that it is from.
    pub sees: usize,
    /// A register of one bit: while it is 0, nothing in that unit follows from the runner.
    pub mask: ValueId,
}

/// A memory; its reads see the words from before the writes, a later write overrules an earlier one.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    /// As of a register.
    pub unit: usize,
    pub path: String,
    pub words: usize,
    pub width: u32,
    pub contents: Contents,
    pub writes: Vec<Write>,
    pub reads: Vec<Read>,
}

/// A write port.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Write {
    pub en: ValueId,
    pub addr: ValueId,
    pub data: ValueId,
}

/// A read port with its registered output.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Read {
    pub en: ValueId,
    pub addr: ValueId,
    pub q: ValueId,
}
