//! Where the registers of arrays lie in the state.

use std::collections::HashMap;

use crate::arrays::Array;
use crate::graph::ValueId;
use crate::layout::Layout;
use crate::tables::Tables;

/// Where the registers of an array lie.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    /// The lowest place, a byte of the state.
    pub lowest: i32,
    /// How many words the place of each register is above the lowest.
    pub words: Vec<u8>,
    /// With a number of several bits: where `words` begin among the tables.
    pub table: Option<usize>,
}

/// The places of all arrays that a byte has room for, by the value that is read from the array.
#[derive(Clone, Debug, Default)]
pub(crate) struct ArrayPlaces(HashMap<usize, Places>);

impl ArrayPlaces {
    /// The places in this layout; the tables get the entries of the arrays.
    pub fn new(tables: &mut Tables, layout: &Layout) -> ArrayPlaces {
        let all = tables.arrays().filter_map(|(value, array)| Some((value, places(array, layout)?)));
        let mut all: Vec<(usize, Places)> = all.collect();
        for (_, places) in all.iter_mut().filter(|(_, places)| places.words.len() > 2) {
            places.table = Some(tables.place(&places.words));
        }
        ArrayPlaces(all.into_iter().collect())
    }

    /// The places of the array that this value is read from.
    pub fn of(&self, value: ValueId) -> Option<&Places> {
        self.0.get(&value.index())
    }
}

/// `None` if a byte has no room for a distance.
fn places(array: &Array, layout: &Layout) -> Option<Places> {
    let offsets: Option<Vec<i32>> =
        array.registers.iter().map(|register| Some(layout.of(*register)?.offset)).collect();
    let offsets = offsets?;
    let lowest = *offsets.iter().min()?;
    let words: Option<Vec<u8>> =
        offsets.iter().map(|offset| u8::try_from((offset - lowest) / 8).ok()).collect();
    Some(Places { lowest, words: words?, table: None })
}
