//! Where everything lies in the state, one buffer of 64-bit words. Each signal has a place of 8 bytes, or of
//! 16 if it is wider than 64 bits, low half first; signals that are compared with their old values stand
//! together. Then come the outputs as they were before the last clock, then the words of the memories, each
//! in the smallest of 1, 2, 4, 8 or 16 bytes.

use std::collections::HashMap;

use crate::design::Design;
use crate::error::JitError;
use crate::graph::{Graph, Kind, ValueId};
use crate::tables::Tables;
use crate::wakes::Wakes;

/// Bytes of two words, which are copied at once.
pub(crate) const PAIR: i32 = 16;

/// Offsets are in bytes from the start of the state, and end within it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    places: HashMap<ValueId, Place>,
    /// Of each output, its value before the last clock.
    pub sampled: Vec<Place>,
    /// Of each memory.
    pub memories: Vec<Area>,
    /// Byte at which the counters of the units begin, a byte each: the clocks for which a unit is to work on.
    pub counters: i32,
    /// Of each unit, where its bits from other units are, as they were in the clock before.
    pub gates: Vec<Vec<Place>>,
    /// Of each unit, the seeds that are compared with what they were.
    pub compared: Vec<Compared>,
    /// 8 bytes that are written only.
    pub unread: i32,
    /// Byte at which the tables begin.
    pub tables: i32,
    /// 64-bit words of the state.
    pub size: usize,
}

/// A signal's place, a multiple of 8.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub offset: i32,
    pub width: u32,
}

/// A memory's place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Area {
    /// A multiple of 8.
    pub offset: i32,
    /// Bytes of a word: 1, 2, 4, 8 or 16.
    pub word: u32,
    /// Words; at least one has room.
    pub words: usize,
    /// Bits of a word.
    pub width: u32,
}

/// Places one after the other, and as many for what was in them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Compared {
    /// A multiple of 8.
    pub offset: i32,
    /// As many bytes from there.
    pub copy: i32,
    /// A multiple of [`PAIR`]; what is behind the places is 0.
    pub bytes: i32,
}

impl Layout {
    /// The layout for all values of the state and all signals with a name.
    ///
    /// # Errors
    /// If all of it is larger than 2 GiB.
    pub fn new(
        design: &Design,
        tables: &Tables,
        wakes: &Wakes,
        shared: &[ValueId],
    ) -> Result<Layout, JitError> {
        let mut layout = Layout::default();
        let graph = &design.graph;
        for unit in 0..wakes.clocks.len() {
            let compared = layout.compared(graph, wakes.compared(unit))?;
            layout.compared.push(compared);
        }
        let stored = graph.ids().filter(|id| *graph.kind(*id) == Kind::Stored);
        for value in stored.chain(design.signals.values().chain(shared).copied()) {
            if !layout.places.contains_key(&value) {
                let place = layout.place(graph, value)?;
                layout.places.insert(value, place);
            }
        }
        for (_, value) in &design.outputs {
            let place = layout.place(graph, *value)?;
            layout.sampled.push(place);
        }
        for memory in &design.memories {
            let word = memory.width.div_ceil(8).next_power_of_two();
            let bytes = memory.words.max(1).checked_mul(word as usize).ok_or(JitError::TooLarge)?;
            let offset = layout.take(bytes)?;
            let (words, width) = (memory.words, memory.width);
            layout.memories.push(Area { offset, word, words, width });
        }
        layout.counters = layout.take(wakes.clocks.len())?;
        for unit in 0..wakes.clocks.len() {
            let gates =
                wakes.gates(unit).iter().map(|gate| layout.place(graph, *gate)).collect::<Result<_, _>>()?;
            layout.gates.push(gates);
        }
        layout.unread = layout.take(8)?;
        layout.tables = layout.take(tables.room())?;
        Ok(layout)
    }

    /// The place of a value that is stored or has a name.
    pub fn of(&self, value: ValueId) -> Option<Place> {
        self.places.get(&value).copied()
    }

    /// Places for these values, which have none yet, and for a copy of them.
    fn compared(&mut self, graph: &Graph, values: &[ValueId]) -> Result<Compared, JitError> {
        let offset = self.take(0)?;
        for value in values {
            let place = self.place(graph, *value)?;
            self.places.insert(*value, place);
        }
        let end = self.take(0)?;
        let bytes = (end - offset + PAIR - 1) / PAIR * PAIR;
        self.take((offset + bytes - end) as usize)?;
        let copy = self.take(bytes as usize)?;
        Ok(Compared { offset, copy, bytes })
    }

    fn place(&mut self, graph: &Graph, value: ValueId) -> Result<Place, JitError> {
        let width = graph.width(value);
        Ok(Place { offset: self.take(width.div_ceil(64) as usize * 8)?, width })
    }

    /// The offset of so many bytes more.
    fn take(&mut self, bytes: usize) -> Result<i32, JitError> {
        let offset = self.size * 8;
        let end =
            offset.checked_add(bytes).filter(|end| i32::try_from(*end).is_ok()).ok_or(JitError::TooLarge)?;
        self.size = end.div_ceil(8);
        Ok(offset as i32)
    }
}
