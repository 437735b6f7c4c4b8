//! The memories of POLY: edges, and the order in which they enter.

use crate::tokens::EdgeWalk;

/// A record of the edge table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Record {
    /// The edge, as it stands on its next line.
    pub walk: EdgeWalk,
    /// n: lines left.
    pub lines: u32,
    /// With bilinear colours: those of the edge.
    pub colours: Colours,
}

/// Red, green and blue of an edge, words of b + r bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Colours {
    /// i: on the edge's line.
    pub values: [u64; 3],
    /// di: to the next line.
    pub steps: [u64; 3],
}

/// A word of the order list: the first line of an edge, and its place in the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Order {
    /// j.
    pub line: u32,
    /// Place of the edge.
    pub index: u32,
}

/// A word of an active list: the column of an edge on the list's line, and its place in the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Word {
    /// C, signed, COLW bits.
    pub column: i32,
    /// With bilinear colours 2^F - 1 - R, else 0: of equal columns the smaller comes first.
    pub below: i32,
    /// Place of the edge.
    pub index: u32,
}

impl Word {
    /// Stands left of another word.
    pub fn is_before(&self, other: &Word) -> bool {
        (self.column, self.below) < (other.column, other.below)
    }
}

/// What is known of a polygon: one is loaded while another is walked.
#[derive(Clone, Debug, Default)]
pub(super) struct Bank {
    /// The edge table.
    pub edges: Vec<Record>,
    /// The order list.
    pub order: Vec<Order>,
}

impl Bank {
    /// For so many edges.
    pub fn new(edges: usize) -> Bank {
        Bank { edges: vec![Record::default(); edges], order: vec![Order::default(); edges] }
    }
}
