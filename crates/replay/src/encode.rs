//! Numbers as few bytes: differences as varints, then deflate, then base64.
//!
//! The stream is that of `docs/replay.md`: for every register the gaps between its changes and the differences of its
//! values, then columns of tokens, then planes of the picture.

use crate::recording::Column;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write as _;

/// Bytes on their way into the file.
#[derive(Debug)]
pub struct Stream {
    /// Not yet deflated.
    bytes: Vec<u8>,
    deflated: DeflateEncoder<Vec<u8>>,
}

/// Bytes that are deflated at a time.
const PIECE: usize = 1 << 16;

impl Default for Stream {
    fn default() -> Self {
        Stream { bytes: Vec::new(), deflated: DeflateEncoder::new(Vec::new(), Compression::best()) }
    }
}

impl Stream {
    /// Seven bits a byte, the least first, the highest bit set where more follow.
    fn varint(&mut self, mut value: u64) {
        while value >= 1 << 7 {
            self.bytes.push(value as u8 | 1 << 7);
            value >>= 7;
        }
        self.bytes.push(value as u8);
        if self.bytes.len() >= PIECE {
            self.deflate();
        }
    }

    fn deflate(&mut self) {
        self.deflated.write_all(&self.bytes).expect("a vector takes every byte");
        self.bytes.clear();
    }

    /// Differences modulo 2^bits, the nearest to 0, their sign in the lowest bit.
    pub fn differences(&mut self, bits: u32, values: impl IntoIterator<Item = u64>) {
        let mut before = 0u64;
        for value in values {
            let difference = (value.wrapping_sub(before) << (64 - bits)) as i64 >> (64 - bits);
            self.varint((difference << 1 ^ difference >> 63) as u64);
            before = value;
        }
    }

    /// The changes of a register.
    pub fn column(&mut self, bits: u32, column: &Column) {
        let mut before = 0;
        for at in &column.at {
            self.varint(u64::from(at - before));
            before = *at;
        }
        self.differences(bits, column.value.iter().copied());
    }

    /// Deflated, as base64.
    #[must_use]
    pub fn pack(mut self) -> String {
        self.deflate();
        STANDARD.encode(self.deflated.finish().expect("a vector takes every byte"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_the_shorter_way_round() {
        let mut stream = Stream::default();
        // 255 to 0 is one up in 8 bits; 64 needs two bytes with its sign.
        stream.differences(8, [255, 0, 64, 63]);
        assert_eq!(stream.bytes, [1, 2, 0x80, 1, 1]);
    }

    #[test]
    fn a_word_of_56_bits_keeps_all_of_them() {
        let mut stream = Stream::default();
        stream.differences(56, [(1 << 55) - 1, 1 << 55]);
        assert_eq!(stream.bytes, [0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f, 2]);
    }

    #[test]
    fn gaps_come_before_values() {
        let mut stream = Stream::default();
        stream.column(4, &Column { at: vec![0, 3, 200], value: vec![5, 4, 6] });
        assert_eq!(stream.bytes, [0, 3, 0xc5, 1, 10, 1, 4]);
    }
}
