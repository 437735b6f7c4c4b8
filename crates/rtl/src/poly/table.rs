//! The memories of POLY: the table of edges, the order list, the active lists.

use edgewalk_machine::{COLOURS, Channel, Plan};
use edgewalk_netlist::{Memory, Module, Signal};

use crate::stepping::parts_of_edge;
use crate::wires::{Part, Token};

/// The memories, and what their words are made of.
pub(super) struct Tables<'m> {
    m: &'m Module,
    /// What no step changes of an edge: its first column, q, f and M - f; a half is loaded, the other walked.
    pub steps: Memory<'m>,
    /// What a step changes: R - f, and the lines left.
    pub rests: Memory<'m>,
    /// First line and number of each edge, by the line; two halves too.
    pub order: Memory<'m>,
    /// Column and number of each edge of a line, by the column: that of the line and that of the next.
    pub lists: Memory<'m>,
    /// With bilinear colours a word of each, as it stands on the edge's line, and its step to the next.
    pub colours: Vec<EdgeColour<'m>>,
    /// The parts of a word of `steps`.
    parts: Vec<Part>,
    /// Bits of an edge's number.
    pub index: u32,
    /// Bits of a column.
    pub column: u32,
    /// Bits by which the active lists are sorted: the column, and with bilinear colours the remainder below it.
    pub key: u32,
    /// What these are.
    pub sorted_by: &'static str,
    /// Bits of a line.
    pub line: u32,
}

/// The words of a colour along edges.
pub(super) struct EdgeColour<'m> {
    pub name: &'static str,
    pub values: Memory<'m>,
    pub steps: Memory<'m>,
}

/// An edge's number beside what it is sorted by: its first line, or its column.
#[derive(Clone, Copy)]
pub(super) struct Word<'m> {
    pub key: Signal<'m>,
    pub index: Signal<'m>,
}

impl<'m> Word<'m> {
    /// As the lists have it.
    pub fn joined(self) -> Signal<'m> {
        self.key.module().cat(&[self.key, self.index])
    }

    /// One of two words.
    pub fn choose(is: Signal<'m>, yes: Word<'m>, no: Word<'m>) -> Word<'m> {
        Word { key: is.mux(yes.key, no.key), index: is.mux(yes.index, no.index) }
    }
}

impl<'m> Tables<'m> {
    /// Without ports.
    pub fn new(m: &'m Module, plan: &Plan, prim: &Token<'m>) -> Tables<'m> {
        m.comment("The table of edges and the lists. A half of each is read while the other is written.");
        let mut parts = parts_of_edge(&prim.parts());
        let bilinear = plan.polygon.is_bilinear();
        // With bilinear colours the first remainder is a part of the key.
        parts.retain(|part| bilinear || part.name != "dist");
        let (places, index) = (plan.polygon.edges, plan.polygon.edges.ilog2());
        let (column, line) = (plan.widths().column, plan.widths().line);
        let rest = prim["minor1_f"].width() + 1;
        let memory = |name: &str, bits: u32| m.memory(name, index + 1, 2 * places as usize, bits);
        let (key, sorted_by) =
            if bilinear { (column + plan.edge_fraction, "column, 2^F - 1 - R") } else { (column, "column") };
        let colour = |channel: &Channel| EdgeColour {
            name: channel.name,
            values: memory(&format!("{}_values", channel.name), channel.word())
                .doc("of each edge the colour on its line"),
            steps: memory(&format!("{}_slopes", channel.name), channel.word())
                .doc("of each edge the colour's step to the next line"),
        };
        let colours = if bilinear { &plan.channels()[COLOURS] } else { &[] };
        let name = |part: &Part| if part.name == "m" { "m - f".to_owned() } else { part.name.clone() };
        let names: Vec<String> = parts.iter().map(name).collect();
        Tables {
            m,
            steps: memory("steps", parts.iter().map(|part| part.width).sum())
                .doc(&format!("of each edge {}, as in the prim", names.join(", "))),
            rests: memory("rests", rest + line + 1).doc("of each edge R - f, signed, and the lines left"),
            order: memory("order", line + index).doc("first line and number of each edge, by the line"),
            lists: memory("lists", key + index)
                .doc(&format!("{sorted_by} and number of each active edge, by the {sorted_by}")),
            colours: colours.iter().map(colour).collect(),
            parts,
            index,
            column,
            key,
            sorted_by,
            line,
        }
    }

    /// A place in a half.
    pub fn at(&self, half: Signal<'m>, place: Signal<'m>) -> Signal<'m> {
        self.m.cat(&[half, place.trunc(self.index)])
    }

    /// A word of the order list or of an active list.
    pub fn word(&self, word: Signal<'m>) -> Word<'m> {
        Word { key: word.slice(word.width() - 1, self.index), index: word.trunc(self.index) }
    }

    /// A word of `steps` from its parts.
    pub fn joined_steps(&self, edge: &Token<'m>) -> Signal<'m> {
        let parts: Vec<Signal<'m>> = self.parts.iter().map(|of| edge[of.name.as_str()]).collect();
        self.m.cat(&parts)
    }

    /// The parts of a word of `steps`.
    pub fn parts_of_steps(&self, word: Signal<'m>) -> Token<'m> {
        let mut above = word.width();
        let part = |part: &Part| {
            above -= part.width;
            (part.clone(), word.slice(above + part.width - 1, above))
        };
        self.parts.iter().map(part).collect()
    }
}
