//! Values that follow from one narrow value, such as the decoded number of an operation. They are looked up
//! in a table instead of computed.

use edgewalk_netlist::Op;
use edgewalk_netlist::ops::Bits;

use crate::arrays::Array;
use crate::graph::{Graph, Kind, ValueId};
use crate::sign_extended::Signs;

/// A value of so many bits or fewer can be an index: a table is a line of a cache at most.
const INDEX_BITS: u32 = 6;

/// The widest value with a table: a byte an entry.
const ENTRY_BITS: u32 = 8;

/// What can be looked up.
pub(crate) struct Tables {
    /// Of each value.
    of: Vec<Option<Table>>,
    /// Of each value that is a choice among registers by a number.
    arrays: Vec<Option<Array>>,
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
    pub fn of(graph: &Graph, signs: &Signs) -> Tables {
        let mut sources: Vec<Source> = Vec::with_capacity(graph.len());
        let mut tables =
            Tables { of: vec![None; graph.len()], arrays: vec![None; graph.len()], bytes: Vec::new() };
        for id in graph.ids() {
            let source = source(graph, &sources, id);
            if let Source::Index(index, depth, entries) = &source
                && (*depth > 1 || is_bit(graph, id))
                && graph.width(id) <= ENTRY_BITS
            {
                let entries: Vec<u8> = entries.iter().map(|entry| *entry as u8).collect();
                let first = tables.place(&entries);
                tables.of[id.index()] = Some(Table { index: *index, first });
            }
            let bits = match graph.as_op(id, Op::Mux).map(|operands| &sources[operands[0].index()]) {
                Some(Source::Index(index, _, bits)) => Some((*index, bits.as_slice())),
                _ => None,
            };
            tables.arrays[id.index()] = match bits {
                Some((index, bits)) => {
                    let array = |arm: ValueId| tables.arrays[arm.index()].clone();
                    Array::of_choice(graph, signs, id, index, bits, array)
                }
                None => Array::of_two(graph, signs, id),
            };
            sources.push(source);
        }
        tables
    }

    /// The table of this value, if it has one.
    pub fn get(&self, id: ValueId) -> Option<Table> {
        self.of[id.index()]
    }

    /// The array that this value is read from, if it is.
    pub fn array(&self, id: ValueId) -> Option<&Array> {
        self.arrays[id.index()].as_ref()
    }

    /// All arrays, with the values that are read from them.
    pub fn arrays(&self) -> impl Iterator<Item = (usize, &Array)> {
        self.arrays.iter().enumerate().filter_map(|(value, array)| Some((value, array.as_ref()?)))
    }

    /// Bytes that all tables have room in, those of arrays too.
    pub fn room(&self) -> usize {
        let arrays = self.arrays.iter().flatten().filter(|array| array.registers.len() > 2);
        self.bytes.len() + arrays.map(|array| array.registers.len()).sum::<usize>()
    }

    /// What must be there to compute the value: its index if it is looked up, else its operands.
    pub fn operands<'a>(&'a self, graph: &'a Graph, id: ValueId) -> &'a [ValueId] {
        match (&self.of[id.index()], &self.arrays[id.index()]) {
            (Some(table), _) => std::slice::from_ref(&table.index),
            (_, Some(array)) => std::slice::from_ref(&array.index),
            _ => graph.operands(id),
        }
    }

    /// Where these entries begin; they may be there already.
    pub fn place(&mut self, entries: &[u8]) -> usize {
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
