//! What NORMAL makes of a pixel's products: the root of N·N, the cosines, and where they stand in SHADE's tables (`docs/machine.md`,
//! section 13).

use super::table_read::TableRead;
use edgewalk_machine::Plan;
use serde::Serialize;
use std::fmt::Write as _;

/// The steps of a fragment.
#[derive(Debug, Serialize)]
pub struct Normal {
    /// N·N from 1/4 to 1, its entry, and 1/√ of it, 2^-16.
    square: i64,
    entry: i64,
    y: i64,
    /// The cosines of each light, 2^-16.
    cosines: Vec<i64>,
    /// Like `cosines`, in entries of SHADE's tables.
    indices: Vec<Index>,
}

/// A cosine in entries of a table.
#[derive(Debug, Serialize)]
pub struct Index {
    name: &'static str,
    index: i64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub read: Option<TableRead>,
}

impl Index {
    /// Of a number with so many bits below an entry, cut to so many bits.
    pub fn of(
        (name, number, below, bits): (&'static str, i64, u32, u32),
        read: impl Fn(i64) -> Option<TableRead>,
    ) -> Index {
        let end = 1i64 << (bits - 1);
        let index = (number >> below).clamp(-end, end - 1);
        Index { name, index, read: read(index) }
    }

    /// As a line of text.
    pub fn text(&self) -> String {
        let Index { name, index, read } = self;
        let read = read.as_ref().map_or_else(String::new, |read| read.text(*index));
        format!("{name}: index {index}{read}\n")
    }
}

/// By light and cosine: the product that NORMAL takes, and the index that it gives.
const NAMES: [[&str; 2]; 4] = [["pl0", "nl0"], ["ph0", "nh0"], ["pl1", "nl1"], ["ph1", "nh1"]];

impl Normal {
    /// Of a pixel: `output` is what comes to NORMAL by its name, `words` those of the memory of the roots, `read` what an index reads.
    pub fn of(
        machine: &Plan,
        words: &[u128],
        gloss: u32,
        output: impl Fn(&str) -> Option<i64>,
        read: impl Fn(usize, i64) -> Option<TableRead>,
    ) -> Option<Normal> {
        let square = output("nn")?.clamp(1 << 14, (1 << 16) - 1);
        let entry = square >> 8;
        let word = *words.get(entry as usize)?;
        let (v, slope) = ((word >> 10) as i64, (word & 0x3ff) as i64);
        let y = (v - ((slope * (square & 0xff) + (1 << 7)) >> 8)) & 0x1_ffff;
        let (t, m) = (machine.shade.table_bits, machine.shade.gloss_bits);
        let (mut cosines, mut indices) = (Vec::new(), Vec::new());
        for (place, [product, name]) in NAMES.into_iter().enumerate() {
            let Some(product) = output(product) else { continue };
            let cosine = (product * y + (1 << 15)) >> 16;
            let number = match place % 2 {
                0 => (name, cosine, 16 - t, t + 2),
                _ => (name, ((cosine - (1 << 16)) << gloss) + (1 << 16), 16 - t, t + m + 2),
            };
            cosines.push(cosine);
            indices.push(Index::of(number, |index| read(place, index)));
        }
        Some(Normal { square, entry, y, cosines, indices })
    }

    /// As lines of text; writing to a string cannot fail.
    pub fn text(&self) -> String {
        let Normal { square, entry, y, .. } = self;
        let mut page = format!("root of N.N: {square} / 2^16; entry {entry}: 1/root {y} / 2^16\n");
        for (cosine, index) in self.cosines.iter().zip(&self.indices) {
            _ = write!(page, "cosine {cosine} / 2^16, {}", index.text());
        }
        page
    }
}
