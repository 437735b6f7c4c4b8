//! Where the words of the program stand: what a machine's counts are made from.

use edgewalk_machine::sequencer::Program;
use edgewalk_machine::sequencer::word::{Act, Control, Factor, Word};
use std::ops::Range;

/// Words of the listing that stand behind one another, and how far the word that waits for the last skipped digit stands behind the
/// one that loads g.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub words: u32,
    pub wait: u32,
}

/// Finds places in a program.
pub(super) struct Listing(pub Program);

impl Listing {
    pub fn label(&self, name: &str) -> usize {
        let place = self.0.labels().find(|(label, _)| *label == name).map(|(_, place)| place);
        place.expect("the listing has the labels of its sums and branches").into()
    }

    /// The first word from a place on of which this holds.
    pub fn find(&self, from: usize, is: impl Fn(&Word) -> bool) -> usize {
        let found = self.0.words[from..].iter().position(is);
        from + found.expect("the listing has a word for each branch")
    }

    pub fn branch(&self, control: Control) -> usize {
        self.find(0, |word| word.control == control)
    }

    /// Words behind the one that waits for room: two loops, over edges and rounds, and what stands between and behind them.
    pub fn load(&self, room: usize, edges: u32, rounds: u32) -> u32 {
        let done = self.find(room, |word| word.act == Some(Act::Done));
        let length = |label: &str| {
            let first = self.label(label);
            (self.branch(Control::Rounds(first as u16)) + 1 - first) as u32
        };
        (done - room) as u32 + (edges - 1) * length("edges") + (rounds - 1) * length("given")
    }

    /// Words up to the area, by the test that finds a column.
    pub fn columns(&self) -> [u32; 4] {
        let area = self.label("area") as u16;
        let mut place = 0;
        [(); 4].map(|()| {
            place = self.find(place, |word| word.control == Control::Negative(area)) + 1;
            place as u32
        })
    }

    /// The three sums from this place on by which the triangle is sheared, the last one with what stands behind it.
    pub fn shear(&self, first: usize) -> [Block; 3] {
        let round = self.label("round");
        let sums: Vec<usize> = (first..round)
            .filter(|place| self.0.words[*place].control == Control::Digits)
            .map(|place| place + 1)
            .collect();
        let [a, b, last] =
            [first..sums[0], sums[0]..sums[1], sums[1]..sums[2]].map(|places| self.block(places));
        [a, b, Block { words: last.words + (round - sums[2]) as u32, ..last }]
    }

    pub fn block(&self, places: Range<usize>) -> Block {
        let loads_g = |word: &Word| word.factor.is_some_and(|(factor, _)| factor == Factor::G);
        let words = places.len() as u32;
        let wait = self.find(places.start, |word| word.control == Control::Settle);
        let load = self.0.words[places.start..wait].iter().rposition(loads_g);
        let load = places.start + load.expect("a sum loads its factors before it waits for their digits");
        Block { words, wait: (wait - load) as u32 }
    }
}
