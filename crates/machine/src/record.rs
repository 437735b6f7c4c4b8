//! What the memories behind TERM, TEXEL, NORMAL, LAMP and SHADE hold, and where in them
//! (`docs/machine.md`, sections 11 to 14, 16 and 17).
//!
//! ```text
//!  Record ──Plan::record_words──> memory `terms`       Entry ──Plan::table_word──> memory `tables`
//! ```
//! The numbers in them are whoever shades': this file says where they stand, not what they are.

use crate::plan::Plan;
use crate::term::{self, Term};

/// What the memory of the terms holds for a triangle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Record {
    /// Column of the reference pixel, may lie off the screen.
    pub x: i32,
    /// Line of the reference pixel, not below the first line drawn.
    pub y: u32,
    /// The material.
    pub material: u32,
    /// Of the material's highlights; with [`crate::ShadeKind::Phong`] alone.
    pub gloss: u32,
    /// For each term of [`Plan::terms`] V, X, Y, XX, XY, YY, modulo 2^w; of degree 1 the last three are not
    /// looked at.
    pub terms: Vec<[u64; 6]>,
}

/// An entry of the tables of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// With [`crate::ShadeColour::Tables`]: red, green, blue, and the highlight, LSB of the colour.
    Colours([u32; 3], u32),
    /// With [`crate::ShadeColour::Multiply`]: the light, 2^(b+2) for 1.0, and the highlight, LSB of the
    /// colour.
    Light(u32, u32),
}

/// Bits of gloss, which goes with the material to NORMAL or LAMP.
pub const GLOSS_BITS: u32 = 4;

impl Plan {
    /// How many of the terms make cosines without a relief: those before BUMP's.
    #[must_use]
    pub fn cosine_terms(&self) -> usize {
        let products =
            if self.shade.is_positional() { term::OF_LAMP.len() } else { 2 * self.shade.lights as usize };
        let all = products + usize::from(self.shade.normalises());
        all.min(self.terms().len()) // none without TERM
    }

    /// How many of the terms make cosines with it: those before the texture's.
    #[must_use]
    pub fn bumped_terms(&self) -> usize {
        self.terms().len() - if self.shade.textures() { 2 } else { 0 }
    }

    /// WR: words of a record.
    #[must_use]
    pub fn record_length(&self) -> u32 {
        3 + self.terms().iter().map(Term::words).sum::<u32>()
    }

    /// wb: bits of the place of a word in its record.
    #[must_use]
    pub fn record_place_bits(&self) -> u32 {
        self.record_length().next_power_of_two().ilog2()
    }

    /// dw: bits of a word of a record.
    #[must_use]
    pub fn record_word_bits(&self) -> u32 {
        let longest = self.terms().iter().map(Term::word).max().unwrap_or(1);
        let gloss = if self.shade.normalises() { GLOSS_BITS } else { 0 };
        longest.max(self.widths().column).max(self.widths().y).max(self.shade.material_bits + gloss)
    }

    /// The words of a record as they lie in the memory, from the record's first place on, 2^wb of them.
    #[must_use]
    pub fn record_words(&self, record: &Record) -> Vec<u64> {
        let mask = u64::MAX >> (64 - self.record_word_bits());
        let gloss =
            if self.shade.normalises() { u64::from(record.gloss) << self.shade.material_bits } else { 0 };
        let material = u64::from(record.material) + gloss;
        let mut words = vec![record.x as u64, record.y.into(), material];
        for (term, own) in self.terms().iter().zip(&record.terms) {
            words.extend(&own[..term.words() as usize]);
        }
        words.resize(1 << self.record_place_bits(), 0);
        words.into_iter().map(|word| word & mask).collect()
    }

    /// The word of an entry of NORMAL's table R, v of 17 bits, slope of 10, or of LAMP's tables, slope of 16;
    /// what has more bits is cut.
    #[must_use]
    pub fn root_word(&self, v: u32, slope: u32) -> u128 {
        let bits = self.slope_bits();
        u128::from(v & 0x1_ffff) << bits | u128::from(slope & ((1 << bits) - 1))
    }

    fn slope_bits(&self) -> u32 {
        if self.shade.is_positional() { 16 } else { 10 }
    }

    /// Bits of such a word.
    #[must_use]
    pub fn root_word_bits(&self) -> u32 {
        17 + self.slope_bits()
    }

    /// Words of the memory of the roots: of NORMAL, or of LAMP.
    #[must_use]
    pub fn root_words(&self) -> u32 {
        if self.shade.is_positional() { 1024 } else { 256 }
    }

    /// The word of a texel: the colour, LSB, and with BUMP the slopes along u and v, 2^(ξ-1) for the relief's
    /// largest; what has more bits is cut.
    #[must_use]
    pub fn texel_word(&self, colours: [u32; 3], slopes: [i32; 2]) -> u128 {
        let put =
            |word: u128, value: u32, bits: u32| word << bits | u128::from(value & (u32::MAX >> (32 - bits)));
        let colour = colours.into_iter().fold(0, |word, colour| put(word, colour, self.color.bits));
        if !self.shade.bumps() {
            return colour;
        }
        slopes.into_iter().fold(colour, |word, slope| put(word, slope as u32, self.shade.slope_bits))
    }

    /// Bits of such a word.
    #[must_use]
    pub fn texel_word_bits(&self) -> u32 {
        3 * self.color.bits + if self.shade.bumps() { 2 * self.shade.slope_bits } else { 0 }
    }

    /// The place of a material's texel in the memory of the textures.
    #[must_use]
    pub fn texel_place(&self, material: u32, u: u32, v: u32) -> usize {
        let bits = self.shade.texture_bits;
        ((material as usize) << bits | v as usize) << bits | u as usize
    }

    /// The word of an entry of the tables; what has more bits than the entry is cut.
    #[must_use]
    pub fn table_word(&self, entry: Entry) -> u128 {
        let bits = self.color.bits;
        let low = |value: u32, bits: u32| u128::from(value) & (u128::MAX >> (128 - bits));
        let (diffuse, highlight) = match entry {
            Entry::Colours(colours, highlight) => {
                (colours.into_iter().fold(0, |word, colour| word << bits | low(colour, bits)), highlight)
            }
            Entry::Light(light, highlight) => (low(light, bits + 3), highlight),
        };
        diffuse << bits | low(highlight, bits)
    }

    /// The place of an entry of a material's light in the memory of the tables.
    #[must_use]
    pub fn table_place(&self, material: u32, light: u32, entry: u32) -> usize {
        ((material as usize) << self.shade.entry_bits())
            + ((light as usize) << self.shade.table_bits)
            + entry as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;

    fn plan(settings: &[(&str, &str)]) -> Plan {
        let mut machine = Machine::default();
        for (key, value) in settings {
            machine.set(key, value).expect("a key");
        }
        machine.plan().expect("can be built")
    }

    #[test]
    fn words_lie_where_the_specification_says() {
        let one = plan(&[("shade.kind", "fast-phong")]);
        let (nl0, nh0) = (one.terms()[0], one.terms()[1]);
        assert_eq!((nl0.word(), nh0.word(), one.record_length(), one.record_place_bits()), (28, 32, 15, 4));
        let terms = vec![[1, 2, 3, 4, 5, 6], [7, 8, 9, 10, 11, u64::MAX]];
        let words = one.record_words(&Record { x: -1, y: 7, material: 5, gloss: 1, terms });
        assert_eq!(words, [u32::MAX.into(), 7, 5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, u32::MAX.into(), 0]);
        assert_eq!(one.table_word(Entry::Colours([1, 2, 3], 4)), 0x0102_0304);
        assert_eq!(one.table_place(3, 0, 5), 3 * 512 + 5);

        let two = plan(&[("shade.kind", "fast-phong"), ("shade.lights", "2"), ("shade.colour", "multiply")]);
        assert_eq!((two.record_length(), two.record_place_bits()), (27, 5));
        assert_eq!(two.table_word(Entry::Light(1024, 255)), 1024 << 8 | 255);
        assert_eq!(two.table_place(1, 1, 0), 1024 + 512);
        let phong = plan(&[("shade.kind", "phong")]);
        let words: Vec<u32> = phong.terms().iter().map(Term::word).collect();
        assert_eq!(
            (&words[..], phong.record_length(), phong.record_word_bits()),
            (&[28, 28, 35][..], 15, 35)
        );
        let terms = vec![[1, 2, 3, 0, 0, 0], [4, 5, 6, 0, 0, 0], [7, 8, 9, 10, 11, 12]];
        let words = phong.record_words(&Record { x: 1, y: 2, material: 5, gloss: 3, terms });
        assert_eq!(words, [1, 2, 3 * 16 + 5, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0]);
        assert_eq!(phong.root_word(0x1_0001, 0x3ff), 0x1_0001 << 10 | 0x3ff);
        assert_eq!(Plan::default().terms(), []);
    }
}
