//! Memory files for `$readmemh`: a number a line in as few lower-case hex digits as it has, LF, a newline at the end
//! (without it Verilator 5.006 drops the last word).

use edgewalk_lockstep::pack::pack;
use edgewalk_lockstep::{Port, Token};
use std::fmt::Write as _;

/// The tokens, each packed with its first field on top.
#[must_use]
pub fn tokens(fields: &[Port], tokens: &[Token]) -> String {
    let widths: Vec<u32> = fields.iter().map(|field| field.width()).collect();
    lines(tokens.iter().map(|token| pack(&widths, token)))
}

/// The words of a memory, from address 0 on.
#[must_use]
pub fn words(words: &[u128]) -> String {
    lines(words.iter().map(|word| format!("{word:x}")))
}

/// Cycles or triangles: the first number, then by how much each is larger than the one before, modulo 2^32.
#[must_use]
pub fn steps(numbers: impl Iterator<Item = u32>) -> String {
    let mut before = 0;
    lines(numbers.map(|number| {
        let step = number.wrapping_sub(before);
        before = number;
        format!("{step:x}")
    }))
}

/// A bit a line, for `$readmemb`.
#[must_use]
pub fn bits(bits: &[bool]) -> String {
    bits.iter().map(|bit| if *bit { "1\n" } else { "0\n" }).collect()
}

fn lines(numbers: impl Iterator<Item = String>) -> String {
    let mut text = String::new();
    for number in numbers {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{number}");
    }
    text
}
