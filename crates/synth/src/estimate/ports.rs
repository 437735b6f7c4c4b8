//! What is known at the ports of a module that stands among others.

use super::family::Family;
use std::hash::{Hash, Hasher};

/// A bit at a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// Nothing is known of it.
    Own,
    /// The bit never changes.
    Constant(bool),
    /// Another input bit is the same.
    Same(u32),
}

/// How a module is looked at. Bits are numbered through the ports in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct View {
    /// By input bit; beyond the end nothing is known.
    pub inputs: Vec<Seen>,
    /// By output bit, how often it is read; beyond the end once.
    pub readers: Vec<u8>,
    /// Instances are not looked into: their outputs are inputs of the module, and their inputs its outputs.
    pub outside: bool,
    /// The module is an instance of another.
    pub inside: bool,
    /// What the module is built of.
    pub family: Family,
}

impl View {
    pub fn seen(&self, input: usize) -> Seen {
        self.inputs.get(input).copied().unwrap_or(Seen::Own)
    }

    pub fn readers(&self, output: usize) -> u8 {
        self.readers.get(output).copied().unwrap_or(1)
    }
}

/// Two input bits a word: views are looked up for each module of each machine.
impl Hash for View {
    fn hash<H: Hasher>(&self, hash: &mut H) {
        let number = |seen: &Seen| match seen {
            Seen::Own => 0,
            Seen::Constant(value) => 1 + u64::from(*value),
            Seen::Same(other) => 3 + u64::from(*other),
        };
        for pair in self.inputs.chunks(2) {
            hash.write_u64(pair.iter().fold(0, |word, seen| word << 32 | number(seen)));
        }
        self.readers.hash(hash);
        (self.outside, self.inside, self.family).hash(hash);
    }
}
