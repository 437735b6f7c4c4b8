//! Values that follow from one narrow value alone, such as what the number of an operation says: they are looked up in a
//! table instead of worked out.

use edgewalk_netlist::Op;
use edgewalk_netlist::ops::Bits;

use crate::graph::{Graph, Kind, ValueId};

/// A value of so many bits or fewer can be an index: a table is a line of a cache at most.
const INDEX_BITS: u32 = 6;

/// The widest value with a table: a byte an entry.
const ENTRY_BITS: u32 = 8;

/// What can be looked up.
pub(crate) struct Tables {
    /// Of each value.
    of: Vec<Option<Table>>,
    /// Entries of all tables, one after the other.
    pub bytes: Vec<u8>,
}

/// Where a value stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Table {
    /// Of 2 to `INDEX_BITS` bits.
    pub index: ValueId,
    /// Of its entry for index 0, in [`Tables::bytes`].
    pub first: usize,
}

/// What a value follows from.
#[derive(Clone, Debug)]
enum Source {
    /// Nothing.
    Constant,
    /// Another value, by so many operators one after the other; the value for each of its values.
    Index(ValueId, u32, Vec<u128>),
    /// Itself, or more than can be an index.
    Other,
}

impl Tables {
    pub fn of(graph: &Graph) -> Tables {
        let mut sources: Vec<Source> = Vec::with_capacity(graph.len());
        let mut tables = Tables { of: vec![None; graph.len()], bytes: Vec::new() };
        for id in graph.ids() {
            let source = source(graph, &sources, id);
            if let Source::Index(index, depth, entries) = &source
                && (*depth > 1 || is_bit(graph, id))
                && graph.width(id) <= ENTRY_BITS
            {
                let first = tables.place(entries);
                tables.of[id.index()] = Some(Table { index: *index, first });
            }
            sources.push(source);
        }
        tables
    }

    /// The table of this value, if it has one.
    pub fn get(&self, id: ValueId) -> Option<Table> {
        self.of[id.index()]
    }

    /// What must be there to compute the value: its index if it is looked up, else its operands.
    pub fn operands<'a>(&'a self, graph: &'a Graph, id: ValueId) -> &'a [ValueId] {
        match &self.of[id.index()] {
            Some(table) => std::slice::from_ref(&table.index),
            None => graph.operands(id),
        }
    }

    /// The same entries may be there already.
    fn place(&mut self, entries: &[u128]) -> usize {
        let entries: Vec<u8> = entries.iter().map(|entry| *entry as u8).collect();
        let there = self.bytes.windows(entries.len()).position(|there| there == entries);
        there.unwrap_or_else(|| {
            let first = self.bytes.len();
            self.bytes.extend(entries);
            first
        })
    }
}

/// To look up a bit of a word is shorter than to move the word, to shift it and to mask it.
fn is_bit(graph: &Graph, id: ValueId) -> bool {
    matches!(graph.kind(id), Kind::Op(Op::Slice { .. }, _)) && graph.width(id) == 1
}

fn source(graph: &Graph, sources: &[Source], id: ValueId) -> Source {
    let Kind::Op(op, operands) = graph.kind(id) else {
        return if graph.as_constant(id).is_some() { Source::Constant } else { Source::Other };
    };
    // An operand that follows from more than an index is one itself if it is narrow.
    let index_of = |operand: &ValueId| match &sources[operand.index()] {
        Source::Constant => None,
        Source::Index(index, ..) => Some(*index),
        Source::Other => Some(*operand),
    };
    let mut indices = operands.iter().filter_map(index_of);
    let Some(index) = indices.next() else { return Source::Constant };
    if indices.any(|other| other != index) || !(2..=INDEX_BITS).contains(&graph.width(index)) {
        return Source::Other;
    }
    let depth = operands.iter().map(|operand| match &sources[operand.index()] {
        Source::Index(_, depth, _) => *depth,
        _ => 0,
    });
    let depth = depth.max().unwrap_or(0) + 1;
    let entry = |at: usize| {
        let operands: Vec<Bits> = operands
            .iter()
            .map(|operand| {
                let value = match &sources[operand.index()] {
                    Source::Index(.., entries) => entries[at],
                    _ => graph.as_constant(*operand).unwrap_or(at as u128),
                };
                Bits { value, width: graph.width(*operand) }
            })
            .collect();
        op.value(graph.width(id), &operands)
    };
    Source::Index(index, depth, (0..1 << graph.width(index)).map(entry).collect())
}
