//! A word of the ROM taken apart, and the row that it reads, for one lane.

use std::collections::BTreeMap;

/// The parts of a word by their names.
#[derive(Clone, Debug)]
pub struct Word(BTreeMap<&'static str, u32>);

impl Word {
    /// The parts of `code`; `fields` are those of the ROM, the most significant first.
    pub fn new(fields: &[(&'static str, u32)], code: u128) -> Word {
        let mut above: u32 = fields.iter().map(|(_, bits)| bits).sum();
        let part = |&(name, bits): &(&'static str, u32)| {
            above -= bits;
            (name, (code >> above) as u32 & ((1 << bits) - 1))
        };
        Word(fields.iter().map(part).collect())
    }

    /// All other parts are alike.
    pub fn differs_in(&self, other: &Word, parts: &[&str]) -> bool {
        self.0.iter().all(|(name, part)| parts.contains(name) || other.0[name] == *part)
    }

    pub fn get(&self, name: &str) -> u32 {
        self.0[name]
    }

    pub fn is(&self, name: &str) -> bool {
        self.get(name) == 1
    }

    /// The row that is read if the number of the round or edge is this one.
    pub fn row(&self, number: u32) -> Row {
        let (row, edge) = (self.get("row"), number & 3);
        match self.get("mode") {
            1 => Row::Digits(row as u8 & !3),
            2 => Row::At((row & !3 | edge) as u8),
            3 => Row::At((row | number) as u8),
            // The picture's: this machine draws no map.
            4 => Row::At(row as u8 & !1),
            mode @ 5..=7 => {
                let place = match (mode, edge) {
                    (6, 2) => 1,
                    (6, _) => 0,
                    (7, 1) => 1,
                    (7, _) => 2,
                    _ => row >> 4 & 3,
                };
                let part = if row & 15 == 15 { (number + 2) & 15 } else { row & 15 };
                match place {
                    3 => Row::At(0xb0 | part as u8),
                    _ => Row::Vertex(place as u8, part as u8),
                }
            }
            _ => Row::At(row as u8),
        }
    }

    /// The row that is written.
    pub fn written(&self, number: u32) -> u8 {
        let row = self.get("write_row");
        (if self.is("write_numbered") { row | number } else { row }) as u8
    }
}

/// A row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Row {
    At(u8),
    /// Of the table that begins here the row of the digits.
    Digits(u8),
    /// Of the vertex at this place of the order the word of this place.
    Vertex(u8, u8),
}
