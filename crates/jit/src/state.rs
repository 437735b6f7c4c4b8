//! The state of a running netlist; `Layout` says where everything lies in it.

use edgewalk_netlist::ops::mask;

use crate::design::Design;
use crate::graph::ValueId;
use crate::layout::{Area, Layout, Place};
use crate::tables::Tables;
use crate::wakes::Wakes;

/// One buffer with all signals, registers and memories.
#[derive(Clone, Debug)]
pub(crate) struct State(Vec<u64>);

impl State {
    /// All 0 but constants and the words of memories.
    pub fn new(design: &Design, tables: &Tables, wakes: &Wakes, layout: &Layout) -> State {
        let mut state = State(vec![0; layout.size]);
        let constants = design.signals.values().filter_map(|value| constant(design, layout, *value));
        constants.for_each(|(place, value)| _ = state.set(place, value));
        for (memory, area) in design.memories.iter().zip(&layout.memories) {
            let word = |address| memory.contents.word(memory.width, address);
            match memory.contents.others {
                Some(0) => {
                    memory.contents.rows.keys().for_each(|row| state.set_word(*area, *row, word(*row)))
                }
                _ => (0..area.words).for_each(|address| state.set_word(*area, address, word(address))),
            }
        }
        state.wake(layout, wakes, u64::MAX);
        let bytes = tables.bytes.iter().enumerate();
        bytes.for_each(|(at, byte)| state.set_byte(layout.tables as usize + at, *byte));
        state
    }

    /// Marks these units as working.
    #[inline]
    pub fn wake(&mut self, layout: &Layout, wakes: &Wakes, units: u64) {
        wakes.units(units).for_each(|(unit, clocks)| self.set_byte(layout.counters as usize + unit, clocks));
    }

    /// For how many clocks a unit is to work on.
    pub fn clocks(&self, layout: &Layout, unit: usize) -> u8 {
        let at = layout.counters as usize + unit;
        (self.0[at / 8] >> (at % 8 * 8)) as u8
    }

    #[inline]
    fn set_byte(&mut self, at: usize, byte: u8) {
        let shift = at % 8 * 8;
        self.0[at / 8] = self.0[at / 8] & !(0xff << shift) | u64::from(byte) << shift;
    }

    /// For the native code.
    pub fn words_mut(&mut self) -> &mut [u64] {
        &mut self.0
    }

    /// The value in a place: above its width there are zeros.
    #[inline]
    pub fn get(&self, place: Place) -> u128 {
        let low = place.offset as usize / 8;
        // Not by index: who takes only the low word does not ask whether there is another.
        let high = if place.width > 64 { self.0.get(low + 1).copied().unwrap_or(0) } else { 0 };
        u128::from(high) << 64 | u128::from(self.0[low])
    }

    /// Sets a place; bits beyond its width are dropped. Returns whether it had another value.
    #[inline]
    pub fn set(&mut self, place: Place, value: u128) -> bool {
        let low = place.offset as usize / 8;
        let mut put = |at: usize, word: u64, width: u32| {
            let word = word & u64::MAX >> (64 - width);
            std::mem::replace(&mut self.0[at], word) != word
        };
        if place.width <= 64 {
            return put(low, value as u64, place.width);
        }
        put(low, value as u64, 64) | put(low + 1, (value >> 64) as u64, place.width - 64)
    }

    /// A word of a memory.
    pub fn word(&self, area: Area, index: usize) -> u128 {
        let (place, shift) = word_place(area, index);
        self.get(place) >> shift & mask(area.width)
    }

    /// Sets a word of a memory.
    pub fn set_word(&mut self, area: Area, index: usize, value: u128) {
        let (place, shift) = word_place(area, index);
        let others = self.get(place) & !(mask(area.width) << shift);
        self.set(place, others | value << shift);
    }
}

/// The 64 or 128 bits that a word of a memory is in, and how many are below it.
fn word_place(area: Area, index: usize) -> (Place, u32) {
    let byte = area.offset as usize + index * area.word as usize;
    let width = if area.word == 16 { 128 } else { 64 };
    (Place { offset: (byte - byte % 8) as i32, width }, (byte % 8) as u32 * 8)
}

fn constant(design: &Design, layout: &Layout, value: ValueId) -> Option<(Place, u128)> {
    Some((layout.of(value)?, design.graph.as_constant(value)?))
}
